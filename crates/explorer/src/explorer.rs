//! The explorer: turns a query string into a picture, numbers or sentences.

use crate::ExplorerError;
use crate::catalogue::catalogue_json;
use crate::depth_pane::depth_svg;
use crate::facts::Facts;
use crate::lesson_state::LessonState;
use crate::line_of_sight::LineOfSight;
use crate::model_store::{LoadedScene, ModelStore, named_style};
use crate::pane_picture::{Drawn, PanePicture, thread_count};
use crate::pane_scene::Observer;
use crate::pick::pick_json;
use crate::request::{DEFAULT_SIZE, Question, Request};
use crate::state_answer::state_json;
use crate::torn_picture::{torn_scene, torn_textures};
use crate::volume_pane::volume_scene;
use crate::words::sentence;
use crate::world_pane::{Pointer, world_scene};
use pipeline::{CancelToken, Monitor, Picture, Textures, draw_lines};
use scene::{ResolveError, Scene};
use scene_file::parse_scene;
use std::sync::Arc;

/// The answer to a request.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Answer {
    /// The media type of the bytes, such as `image/svg+xml`. Pixels are `application/octet-stream`:
    /// sRGB with straight alpha, four bytes each, rows from the top.
    pub content_type: &'static str,
    /// The answer in this format.
    pub bytes: Vec<u8>,
}

/// The lessons on the viewing pipeline, with answers to requests about their states.
///
/// Loaded models and resolved scenes are cached, so dragging a control costs only a picture.
/// Answers do not depend on earlier requests.
#[derive(Debug, Default)]
pub struct Explorer {
    store: ModelStore,
    /// The main picture. Its scene is cached only if the triangles are torn.
    picture: Pane,
    /// The `world` pane with its scene, cached under the key of its state.
    world: Pane,
    volume: Pane,
}

/// A pane's pictures and its last scene.
#[derive(Debug, Default)]
struct Pane {
    picture: PanePicture,
    scene: Option<(String, Arc<Scene>)>,
}

impl Pane {
    /// Returns the last scene if it has this key.
    fn known_scene(&self, key: &str) -> Option<Arc<Scene>> {
        let known = self.scene.as_ref().filter(|(known, _)| known == key);
        known.map(|(_, scene)| Arc::clone(scene))
    }
}

impl Explorer {
    /// Creates an explorer without files.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a model file, or replaces the file with this name. `name` is its path in scene files,
    /// such as `models/house.glb`. The buffers and images of a `.gltf` file are looked up relative
    /// to it.
    ///
    /// # Errors
    /// Returns an error if the name is empty or absolute, or leads out of the files' folder.
    pub fn add_file(&mut self, name: &str, bytes: Vec<u8>) -> Result<(), ExplorerError> {
        self.store.add_file(name, bytes)?;
        // Cached pictures may show the replaced file.
        (self.picture, self.world, self.volume) = Default::default();
        Ok(())
    }

    /// Creates another explorer with the same files and loaded models. Both share them in memory
    /// and can answer requests at the same time.
    #[must_use]
    pub fn sibling(&self) -> Self {
        Self { store: self.store.clone(), ..Self::default() }
    }

    /// Answers a request: a query string with the keys listed in the README.
    ///
    /// # Errors
    /// Returns an error if a key is unknown, repeated or malformed, if a model is missing or
    /// broken, or if the scene is invalid. The explorer is then unchanged.
    pub fn answer(&mut self, query: &str) -> Result<Answer, ExplorerError> {
        self.answer_unless_canceled(query, &CancelToken::default())
    }

    /// Answers a request as [`answer`](Self::answer) does, unless another thread cancels it. Line
    /// drawing and model loading are not interrupted.
    ///
    /// # Errors
    /// Returns the same errors as `answer`, and `cannot_render` if the picture is canceled.
    pub fn answer_unless_canceled(
        &mut self,
        query: &str,
        cancel: &CancelToken,
    ) -> Result<Answer, ExplorerError> {
        let monitor: Arc<dyn Monitor> = Arc::new(cancel.clone());
        let request = Request::parse(query)?;
        match request.question {
            Question::Lessons => Ok(json_answer(&catalogue_json())),
            Question::State => self.state(&request),
            Question::Picture => self.picture(&request, &monitor),
            Question::World | Question::Volume => self.pane(&request, &monitor),
            Question::Depth => self.depth(&request),
            Question::Drawing => self.drawing(&request),
            Question::Pick => self.pick(&request),
        }
    }

    /// Returns the scene and its text, for a picture of a given size.
    fn load(
        &mut self,
        state: &LessonState,
        size: [u32; 2],
        samples: u32,
    ) -> Result<(String, LoadedScene), ExplorerError> {
        self.check_models(state)?;
        let lesson = state.lesson;
        let own = state.model.as_deref().unwrap_or_default();
        let own_text = lesson.draws_own_file().then(|| self.store.scene_text(own));
        let mut file = match &own_text {
            Some(text) => parse_scene(own, text).map_err(ResolveError::Scene)?,
            None => (lesson.describe)(&state.values(size))?,
        };
        (file.image.size, file.image.samples) = (size.into(), samples);
        file.style = state.style.and_then(named_style).unwrap_or(file.style);
        let text = match own_text {
            Some(text) => text,
            None => {
                let text = file.to_ron().map_err(|error| ExplorerError::invalid_scene(&error))?;
                format!("// {}{}\n{text}", lesson.title.en, lesson.remark)
            }
        };
        // The user's scene file keeps its text, so the key also needs size, samples and style.
        let key = format!("{size:?} {samples} {:?} {text}", state.style);
        let loaded = self.store.resolve(key, &text, &file);
        let loaded = loaded.map_err(|error| error.about_model(own))?;
        // The program contains the lesson models, so a copied scene works in every folder.
        let text = lesson.models.iter().fold(text, |text, path| {
            let name = path.trim_start_matches("models/").trim_end_matches(".glb");
            text.replace(&format!("\"{path}\""), &format!("\"lesson:{name}\""))
        });
        Ok((text, LoadedScene { first_view: lesson.first_view, ..loaded }))
    }

    /// Checks that all of a state's models have been added.
    fn check_models(&self, state: &LessonState) -> Result<(), ExplorerError> {
        let own = state.model.as_deref().filter(|_| state.lesson.models.is_empty());
        let missing =
            state.lesson.models.iter().copied().chain(own).find(|name| !self.store.has_file(name));
        if let Some(name) = missing {
            let message = format!("the file `{name}` has not been added");
            let help = "drop it on the page, or pass it to the program";
            return Err(ExplorerError::new("missing_model", message, help));
        }
        if state.lesson.models.is_empty() && own.is_none() {
            return Err(ExplorerError::in_language(
                "missing_model",
                state.language,
                sentence("no model has been chosen", "还没有选择模型"),
                sentence("drop a model on the page", "请把模型文件拖放到页面上"),
            ));
        }
        Ok(())
    }

    fn state(&mut self, request: &Request) -> Result<Answer, ExplorerError> {
        let (text, loaded) = self.load(&request.state, request.size, request.samples)?;
        let facts = Facts::new(&loaded);
        Ok(json_answer(&state_json(request, &text, &loaded, &facts)?))
    }

    fn picture(
        &mut self,
        request: &Request,
        monitor: &Arc<dyn Monitor>,
    ) -> Result<Answer, ExplorerError> {
        let (text, loaded) = self.load(&request.state, request.size, request.samples)?;
        let Request { state, size, samples, .. } = request;
        let key = format!("{size:?} {samples} {:?} {} {text}", state.style, state.is_torn());
        let pane = &mut self.picture;
        if !state.is_torn() {
            let drawn = Drawn { scene: &loaded.scene, textures: &loaded.models.textures, monitor };
            return answer_with_pixels(&mut pane.picture, request, &key, drawn);
        }
        let scene = match pane.known_scene(&key) {
            Some(scene) => scene,
            None => Arc::new(torn_scene(&loaded)?),
        };
        pane.scene = Some((key.clone(), Arc::clone(&scene)));
        let drawn = Drawn { scene: &scene, textures: &torn_textures(), monitor };
        answer_with_pixels(&mut pane.picture, request, &key, drawn)
    }

    fn depth(&mut self, request: &Request) -> Result<Answer, ExplorerError> {
        let (_, loaded) = self.load(&request.state, DEFAULT_SIZE, 4)?;
        let svg = depth_svg(&Facts::new(&loaded), request.state.lesson.conventions)?;
        Ok(svg_answer(svg))
    }

    fn drawing(&mut self, request: &Request) -> Result<Answer, ExplorerError> {
        let (_, loaded) = self.load(&request.state, request.size, 4)?;
        let torn = request.state.is_torn().then(|| torn_scene(&loaded)).transpose()?;
        let scene = torn.as_ref().unwrap_or(&loaded.scene);
        let page = draw_lines(scene, thread_count(), &Default::default())?;
        Ok(svg_answer(page.to_svg()))
    }

    fn pick(&mut self, request: &Request) -> Result<Answer, ExplorerError> {
        let pixel = request.pixel.ok_or_else(|| {
            let help = "add pixel=x,y, a position measured from the upper left corner";
            ExplorerError::new("malformed_query", "missing key `pixel`", help)
        })?;
        if request.state.is_torn() {
            return Err(ExplorerError::in_language(
                "nothing_there",
                request.state.language,
                sentence(
                    "the triangles in this picture are not where they appear",
                    "这幅图像中的三角形并不在它们看起来的位置",
                ),
                sentence("choose `clip first`, then click", "请先选择“先裁剪”，再点击"),
            ));
        }
        let (_, loaded) = self.load(&request.state, request.size, request.samples)?;
        let conventions = request.state.lesson.conventions;
        Ok(json_answer(&pick_json(&loaded.scene, conventions, pixel)?))
    }

    /// Renders a pane next to the main picture.
    fn pane(
        &mut self,
        request: &Request,
        monitor: &Arc<dyn Monitor>,
    ) -> Result<Answer, ExplorerError> {
        let Request { question, state, size, samples, .. } = request;
        let is_world = *question == Question::World;
        let orbit = if is_world { state.orbit() } else { state.volume_orbit() };
        let observer = Observer { orbit, size: *size, samples: *samples };
        // The main picture's aspect ratio may differ from the pane's.
        let (text, loaded) = self.load(state, DEFAULT_SIZE, 4)?;
        let key = format!("{observer:?} {} {text}", state.to_link());
        let known = if is_world { &self.world } else { &self.volume }.known_scene(&key);
        let scene = match known {
            Some(scene) => scene,
            None if is_world => {
                let (_, defaults) = self.load(&state.with_defaults(), DEFAULT_SIZE, 4)?;
                let pointer = pointer(state, &loaded);
                Arc::new(world_scene(&loaded, &defaults, observer, pointer)?)
            }
            None => {
                let (facts, lesson) = (Facts::without_survey(&loaded), state.lesson);
                let stage = (lesson.volume)(&state.values(DEFAULT_SIZE));
                let pointer = pointer(state, &loaded);
                let conventions = lesson.conventions;
                Arc::new(volume_scene(&facts, stage, conventions, observer, pointer)?)
            }
        };
        let pane = if is_world { &mut self.world } else { &mut self.volume };
        pane.scene = Some((key.clone(), Arc::clone(&scene)));
        let textures = Textures::for_models(&[]);
        let drawn = Drawn { scene: &scene, textures: &textures, monitor };
        answer_with_pixels(&mut pane.picture, request, &key, drawn)
    }
}

/// Returns the point under the lesson's mouse, or else the pinned point, with its line of sight.
fn pointer(state: &LessonState, loaded: &LoadedScene) -> Pointer {
    let view = &loaded.views()[0].view_projection;
    match (state.lesson.pointer)(&state.values(DEFAULT_SIZE)) {
        Some(position) => {
            let sight = LineOfSight::through_picture(view, position);
            let triangles = &loaded.models.triangles.counted;
            Pointer { point: sight.and_then(|sight| sight.first_hit(triangles)), sight }
        }
        None => {
            let point = state.pin(loaded).into();
            Pointer { point: Some(point), sight: LineOfSight::through_point(view, point) }
        }
    }
}

fn answer_with_pixels(
    pane: &mut PanePicture,
    request: &Request,
    key: &str,
    drawn: Drawn<'_>,
) -> Result<Answer, ExplorerError> {
    if let Some(rows) = request.rows {
        return Ok(pixels_answer(pane.band(key, drawn, rows)?));
    }
    let whole: &Picture = pane.whole(key, drawn)?;
    Ok(match request.is_png {
        true => Answer { content_type: "image/png", bytes: whole.to_png() },
        false => pixels_answer(whole.pixels.as_flattened().to_vec()),
    })
}

fn pixels_answer(bytes: Vec<u8>) -> Answer {
    Answer { content_type: "application/octet-stream", bytes }
}

fn svg_answer(svg: String) -> Answer {
    Answer { content_type: "image/svg+xml", bytes: svg.into_bytes() }
}

fn json_answer(json: &serde_json::Value) -> Answer {
    Answer { content_type: "application/json", bytes: json.to_string().into_bytes() }
}
