//! Mesa's llvmpipe, which runs OpenGL on the processor, with shaders compiled to machine code and
//! one thread (`LP_NUM_THREADS=0`).

use super::Peer;
use crate::gl::{Context, Framebuffer, Part as GlPart, Program};
use crate::scene::{AMBIENT, SIZE, Scene, TOWARDS_LIGHT};
use projection::Convention;
use std::rc::Rc;

const VERTEX: &str = "#version 120
attribute vec3 position;
attribute vec3 normal;
attribute vec2 uv;
uniform mat4 world_to_clip;
varying vec3 n;
varying vec2 t;
void main() {
    gl_Position = world_to_clip * vec4(position, 1.0);
    n = normal;
    t = uv;
}
";

/// Returns the fragment shader for one kind of part.
fn fragment(lit: bool, textured: bool) -> String {
    let [x, y, z] = TOWARDS_LIGHT;
    let texel = if textured { "color *= texture2D(image, t).rgb;" } else { "" };
    let light = format!(
        "color *= {AMBIENT} + {} * max(dot(normalize(n), vec3({x}, {y}, {z})), 0.0);",
        1.0 - AMBIENT
    );
    let light = if lit { light } else { String::new() };
    format!(
        "#version 120
uniform vec3 tint;
uniform sampler2D image;
varying vec3 n;
varying vec2 t;
void main() {{
    vec3 color = tint;
    {texel}
    {light}
    gl_FragColor = vec4(color, 1.0);
}}
"
    )
}

/// The llvmpipe rasterizer with a scene.
pub struct Llvmpipe {
    gl: Rc<Context>,
    /// The render target. With several samples, `resolved` receives their means.
    target: Framebuffer,
    resolved: Option<Framebuffer>,
    samples: u32,
    parts: Vec<(Program, GlPart)>,
}

impl Llvmpipe {
    /// Uploads the scene and compiles its shaders.
    pub fn new(gl: &Rc<Context>, scene: &Scene, samples: u32) -> Result<Self, String> {
        let gl = Rc::clone(gl);
        let geometry = gl.geometry(&scene.vertices, &scene.indices)?;
        let textures = scene.textures.iter().map(|texture| gl.texture(texture));
        let textures = textures.collect::<Result<Vec<_>, _>>()?;
        let matrix = scene.world_to_clip(Convention::OPENGL).raw().as_mat4();
        let mut programs = Vec::new();
        for (lit, textured) in [(false, false), (false, true), (true, false), (true, true)] {
            let used = scene.parts.iter().any(|p| (p.lit, p.texture.is_some()) == (lit, textured));
            let program = || gl.program(VERTEX, &fragment(lit, textured), matrix.to_cols_array());
            programs.push(used.then(program).transpose()?);
        }
        let mut parts = Vec::new();
        for part in &scene.parts {
            let kind = usize::from(part.lit) * 2 + usize::from(part.texture.is_some());
            let program = programs[kind].ok_or("missing shader for a kind of part")?;
            let texture = part.texture.map(|at| textures[at]);
            let (indices, cull) = (part.indices.clone(), !part.two_sided);
            parts.push((program, geometry.part(indices, part.tint, texture, cull)?));
        }
        let resolved = (samples > 1).then(|| gl.framebuffer(SIZE, 1)).transpose()?;
        Ok(Self { target: gl.framebuffer(SIZE, samples)?, resolved, samples, parts, gl })
    }
}

impl Peer for Llvmpipe {
    fn name(&self) -> String {
        if self.samples == 1 { "llvmpipe".into() } else { format!("llvmpipe {}x", self.samples) }
    }

    fn is_comparable(&self) -> bool {
        self.samples == 1
    }

    fn draw(&mut self) {
        self.gl.begin(&self.target);
        for (program, part) in &self.parts {
            self.gl.draw(*program, part);
        }
        if let Some(resolved) = &self.resolved {
            self.gl.resolve(&self.target, resolved);
        }
        self.gl.finish();
    }

    fn pixels(&mut self) -> Vec<[u8; 4]> {
        self.gl.read(self.resolved.as_ref().unwrap_or(&self.target))
    }
}
