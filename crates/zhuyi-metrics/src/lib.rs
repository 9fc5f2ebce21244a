//! What others say of the same scene: other models of safe driving, and metrics of criticality.
//!
//! ```text
//!                       ┌─▶ safety_models: how late may the ego react?  ──▶ Reaction ──▶ Estimator::by_model ──▶ Estimate
//!  Ego, actor, Future ──┤
//!                       └─▶ criticality: TTC, THW, DRAC, PET, TTB, BTN, impact speed
//! ```
//!
//! | question | ask |
//! |---|---|
//! | what RSS, SFF, UN R157 or another model asks for | a model of [`safety_models`], all of them by [`SafetyModels`](safety_models::SafetyModels) |
//! | how others call the situation | [`criticality::criticality`] |
//!
//! Both look at what the estimator looks at, an [`Ego`](zhuyi_estimator::Ego) and a [`Future`](zhuyi_estimator::Future) of one
//! actor, and allocate nothing. The estimator knows neither: a model meets it through the trait
//! [`SafetyModel`](zhuyi_estimator::SafetyModel).

pub mod criticality;
pub mod safety_models;
