//! The pictures that lights have of a scene: shadow maps, rendered by the same stages as the picture itself.

mod casters;
mod fit;

use super::RenderError;
use super::images::Images;
use super::stage::Stage;
use crate::scene::Scene;
pub(super) use casters::Casters;
use casters::add_casters;
use fit::Fit;
use raster::{Frame, Samples};
use shade::{Draw, DrawList, ShadowMap};

/// What shadow maps are made in, kept from picture to picture.
#[derive(Debug, Default)]
pub(super) struct ShadowMemory {
    frame: Option<Frame>,
    images: Images,
    /// The map of each light that casts shadows; as many as there are lights, or none.
    pub(super) maps: Vec<Option<ShadowMap>>,
    /// Maps that are not used at the moment.
    spare: Vec<ShadowMap>,
}

impl ShadowMemory {
    /// Takes all maps out and keeps their memory.
    pub(super) fn clear(&mut self) {
        // The first map that is asked for next time is the one of the first light.
        self.spare.extend(self.maps.drain(..).rev().flatten());
    }

    /// Makes the maps of a scene's lights with up to `threads` threads, whose number does not change them.
    pub(super) fn render<'a>(
        &mut self,
        scene: &'a Scene,
        textures: &'a super::Textures<'a>,
        threads: usize,
    ) -> Result<(), RenderError> {
        self.clear();
        if scene.lights.iter().all(|light| light.shadow().is_none()) {
            return Ok(());
        }
        for light in &scene.lights {
            let fit = light.shadow().and_then(|shadow| Fit::of(scene, light, shadow));
            let map = match fit {
                Some(fit) => Some(self.map(scene, textures, &fit, threads)?),
                None => None,
            };
            self.maps.push(map);
        }
        Ok(())
    }

    fn map<'a>(
        &mut self,
        scene: &'a Scene,
        textures: &'a super::Textures<'a>,
        fit: &Fit,
        threads: usize,
    ) -> Result<ShadowMap, RenderError> {
        let [width, height] = fit.size;
        let mut frame = match self.frame.take() {
            Some(mut frame) => {
                frame.restart(width, height, Samples::One)?;
                frame
            }
            None => Frame::new(width, height, Samples::One)?,
        }
        .with_threads(threads);
        let stage = Stage::new(&fit.view_projection, width, height)?;
        let mut draws = DrawList { draws: Vec::<Draw<'a>>::new() };
        add_casters(scene, textures, &stage, threads, &mut self.images, &mut frame, &mut draws)?;
        let mut map = self.spare.pop().unwrap_or_default();
        let to_screen = stage.ndc_to_screen.raw();
        map.restart(to_screen * fit.view_projection.world_to_clip().raw(), fit.size, fit.middle);
        map.soften(fit.spread, fit.at_infinity);
        frame.nearest(&Casters(&draws), threads, &mut map.texels);
        self.frame = Some(frame);
        Ok(map)
    }
}
