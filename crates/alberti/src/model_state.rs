//! Flags that choose a state of a model: which scene, which variant, which moment of which animation.

use pipeline::scene::file::{Choice, Finite, ModelFile};

/// A state of a model.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct ModelStateArgs {
    /// A scene of the model, by name or by number from 0 [default: the one the model names]
    #[arg(long, value_name = "NAME|INDEX", value_parser = choice)]
    pub(crate) scene: Option<Choice>,
    /// A variant of the model's materials, by name or by number from 0
    #[arg(long, value_name = "NAME|INDEX", value_parser = choice)]
    pub(crate) variant: Option<Choice>,
    /// An animation of the model that poses it, by name or by number from 0 [default: the first, with --time]
    #[arg(long, value_name = "NAME|INDEX", value_parser = choice)]
    pub(crate) animation: Option<Choice>,
    /// The time of the animation in seconds [default: 0, with --animation]
    #[arg(long, value_name = "SECONDS", value_parser = time, allow_negative_numbers = true)]
    pub(crate) time: Option<Finite>,
}

impl ModelStateArgs {
    /// What the flags say goes before what a scene says of its model.
    pub(crate) fn apply_to(&self, model: &mut ModelFile) {
        let or = |flag: &Option<Choice>, said: &mut Option<Choice>| {
            if flag.is_some() {
                said.clone_from(flag);
            }
        };
        or(&self.scene, &mut model.scene);
        or(&self.variant, &mut model.variant);
        or(&self.animation, &mut model.animation);
        model.time = self.time.or(model.time);
    }
}

/// Digits are a number, everything else is a name.
fn choice(text: &str) -> Result<Choice, String> {
    Ok(text.parse().map_or_else(|_| Choice::Name(text.to_owned()), Choice::Index))
}

fn time(text: &str) -> Result<Finite, String> {
    let seconds = text.parse().ok().and_then(Finite::new);
    seconds.ok_or_else(|| "expected a number of seconds, such as 1.5".to_owned())
}
