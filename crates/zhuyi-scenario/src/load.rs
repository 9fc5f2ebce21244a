//! From texts to meaning.

use crate::invalid::Invalid;
use crate::model::{Scenario, System};
use crate::read;
use crate::reading::Reading;
use crate::source::{Kind, Setting, Source};

impl System {
    /// The system that a source holds, with the settings that belong to one; others are passed over.
    ///
    /// # Errors
    /// All violations of both.
    pub fn read(source: &Source, settings: &[Setting]) -> Result<Self, Invalid> {
        let reading = Reading::new(
            settings
                .iter()
                .filter(|setting| setting.kind() == Kind::System),
        );
        let system = read::system(&reading.root(source)?);
        reading.finish(system)
    }
}

impl Scenario {
    /// The scenario that a source holds, with the settings that belong to one; others are passed over. Its name is the
    /// source's without folder and `.ron`. The system gives the gap of actors that start `Steady`, and the ego's box.
    ///
    /// # Errors
    /// All violations of both.
    pub fn read(source: &Source, system: &System, settings: &[Setting]) -> Result<Self, Invalid> {
        read_scenario(source, Some(system), settings)
    }
}

fn read_scenario(
    source: &Source,
    system: Option<&System>,
    settings: &[Setting],
) -> Result<Scenario, Invalid> {
    let reading = Reading::new(
        settings
            .iter()
            .filter(|setting| setting.kind() == Kind::Scenario),
    );
    let scenario = read::scenario(&reading.root(source)?, source.stem(), system);
    reading.finish(scenario)
}

/// A scenario and the system that drives through it, with settings of both kinds.
///
/// # Errors
/// All violations of either; what depends on a broken system goes unchecked.
pub fn load(
    scenario: &Source,
    system: &Source,
    settings: &[Setting],
) -> Result<(Scenario, System), Invalid> {
    let system = System::read(system, settings);
    let scenario = read_scenario(scenario, system.as_ref().ok(), settings);
    match (scenario, system) {
        (Ok(scenario), Ok(system)) => Ok((scenario, system)),
        (Err(scenario), Err(system)) => Err(scenario.and(system)),
        (Err(invalid), Ok(_)) | (Ok(_), Err(invalid)) => Err(invalid),
    }
}
