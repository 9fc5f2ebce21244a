//! Reading files: those that come with the program, broken ones, settings, and anything at all.

#[cfg(test)]
mod files;
#[cfg(test)]
mod pace;
#[cfg(test)]
mod plans;
#[cfg(test)]
mod robustness;
#[cfg(test)]
mod settings;
#[cfg(test)]
mod texts;
#[cfg(test)]
mod violations;
