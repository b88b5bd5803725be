//! Outputs of a scene: the bits per channel, and the passes written in addition to the picture.

use super::Origin;
use scene_file::PathStep::Field;
use scene_file::{Pass, PassEncoding, SceneError, SceneFile};

/// The outputs of a scene.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Outputs {
    /// Whether channels have 16 bits instead of 8.
    pub sixteen_bit: bool,
    /// The passes to write in addition to the picture.
    pub passes: Vec<Pass>,
    /// The file format of passes.
    pub encoding: PassEncoding,
}

impl Outputs {
    /// Returns the outputs that a scene file requests.
    ///
    /// # Errors
    /// Returns an error that points at the number of bits if it is unsupported.
    pub fn from_scene_file(origin: &Origin, file: &SceneFile) -> Result<Self, SceneError> {
        let bits = file.image.bits;
        if bits != 8 && bits != 16 {
            let message = format!("invalid number of bits per channel: {bits}");
            let help = Some("write 8 or 16".to_owned());
            return Err(origin.error_at(&[Field("image"), Field("bits")], message, help));
        }
        let mut passes = file.passes.write.clone();
        passes.sort_unstable();
        passes.dedup();
        Ok(Self { sixteen_bit: bits == 16, passes, encoding: file.passes.encoding })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene_file::{SceneErrors, parse_scene};

    fn outputs(text: &str) -> Result<Outputs, SceneErrors> {
        let text = format!("Scene(models: [(path: \"a.glb\")],\n  {text})");
        let file = parse_scene("scene.ron", &text)?;
        let origin = Origin::from_text("scene.ron", text, ".".into());
        Ok(Outputs::from_scene_file(&origin, &file)?)
    }

    #[test]
    fn passes_and_bits_come_from_the_file() {
        assert_eq!(outputs("").expect("defaults"), Outputs::default());
        let found = outputs("image: (bits: 16), passes: (write: [Uv, Depth, Uv], encoding: Npy)");
        let passes = vec![Pass::Depth, Pass::Uv];
        let due = Outputs { sixteen_bit: true, passes, encoding: PassEncoding::Npy };
        assert_eq!(found.expect("a scene"), due);
    }

    #[test]
    fn mistakes_are_located() {
        let error = outputs("image: Image(bits: 10)").expect_err("ten bits");
        assert_eq!(error.first().line_and_column(), (2, 22));
        assert_eq!(error.first().message, "invalid number of bits per channel: 10");
        let error = outputs("passes: (write: [Depht])").expect_err("no such pass");
        assert_eq!(error.first().help.as_deref(), Some("did you mean `Depth`?"));
    }
}
