//! Mesa's software OpenGL, found at run time: the only module that calls foreign code.
//!
//! Every call goes through a pointer that was looked up by name in the library and has the type
//! given by the OpenGL 3.0 and OSMesa headers. The calls are sound for these reasons:
//!
//! - the library stays loaded as long as the process lives, because its handle is leaked;
//! - a context is current on the thread that created it, and [`Context`] cannot leave that thread
//!   because it holds raw pointers;
//! - data read through a pointer during a call is a slice that outlives the call, with its own
//!   length; OpenGL copies the data it keeps (`glBufferData`, `glTexImage2D`, `glShaderSource`),
//!   except for OSMesa's own picture, which the context owns;
//! - data is written only to buffers of the size that the call's arguments state;
//! - draw calls read buffers by indices that were checked against the number of vertices.
#![allow(unsafe_code)]

mod name;

use crate::scene::{Texture, Vertex};
use libloading::Library;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_uchar, c_uint, c_void};
use std::ops::Range;
use std::ptr::{null, null_mut};

/// The library names, newest first.
const NAMES: [&str; 2] = ["libOSMesa.so.8", "libOSMesa.so.6"];

/// Declares a table of functions and their lookup.
macro_rules! functions {
    ($($field:ident = $symbol:literal ($($argument:ty),*) $(-> $result:ty)?;)*) => {
        struct Functions { $($field: unsafe extern "C" fn($($argument),*) $(-> $result)?),* }

        impl Functions {
            fn load(library: &Library) -> Result<Self, String> {
                Ok(Self { $(
                    // SAFETY: the symbol is a function of the type declared in the OpenGL and
                    // OSMesa headers, and the library is never unloaded.
                    $field: *unsafe { library.get($symbol) }.map_err(|error| error.to_string())?,
                )* })
            }
        }
    };
}

functions! {
    create_context = "OSMesaCreateContextExt" (c_uint, c_int, c_int, c_int, *mut c_void) -> *mut c_void;
    make_current = "OSMesaMakeCurrent" (*mut c_void, *mut c_void, c_uint, c_int, c_int) -> c_uchar;
    get_string = "glGetString" (c_uint) -> *const c_char;
    gen_framebuffers = "glGenFramebuffers" (c_int, *mut c_uint);
    bind_framebuffer = "glBindFramebuffer" (c_uint, c_uint);
    check_framebuffer = "glCheckFramebufferStatus" (c_uint) -> c_uint;
    gen_renderbuffers = "glGenRenderbuffers" (c_int, *mut c_uint);
    bind_renderbuffer = "glBindRenderbuffer" (c_uint, c_uint);
    renderbuffer_storage = "glRenderbufferStorageMultisample" (c_uint, c_int, c_uint, c_int, c_int);
    attach = "glFramebufferRenderbuffer" (c_uint, c_uint, c_uint, c_uint);
    blit = "glBlitFramebuffer"
        (c_int, c_int, c_int, c_int, c_int, c_int, c_int, c_int, c_uint, c_uint);
    gen_buffers = "glGenBuffers" (c_int, *mut c_uint);
    bind_buffer = "glBindBuffer" (c_uint, c_uint);
    buffer_data = "glBufferData" (c_uint, isize, *const c_void, c_uint);
    attribute = "glVertexAttribPointer" (c_uint, c_int, c_uint, c_uchar, c_int, *const c_void);
    enable_attribute = "glEnableVertexAttribArray" (c_uint);
    create_shader = "glCreateShader" (c_uint) -> c_uint;
    shader_source = "glShaderSource" (c_uint, c_int, *const *const c_char, *const c_int);
    compile = "glCompileShader" (c_uint);
    shader_status = "glGetShaderiv" (c_uint, c_uint, *mut c_int);
    create_program = "glCreateProgram" () -> c_uint;
    attach_shader = "glAttachShader" (c_uint, c_uint);
    bind_attribute = "glBindAttribLocation" (c_uint, c_uint, *const c_char);
    link = "glLinkProgram" (c_uint);
    program_status = "glGetProgramiv" (c_uint, c_uint, *mut c_int);
    use_program = "glUseProgram" (c_uint);
    uniform_location = "glGetUniformLocation" (c_uint, *const c_char) -> c_int;
    uniform_vec3 = "glUniform3f" (c_int, f32, f32, f32);
    uniform_mat4 = "glUniformMatrix4fv" (c_int, c_int, c_uchar, *const f32);
    gen_textures = "glGenTextures" (c_int, *mut c_uint);
    bind_texture = "glBindTexture" (c_uint, c_uint);
    texture_parameter = "glTexParameteri" (c_uint, c_uint, c_int);
    texture_image = "glTexImage2D"
        (c_uint, c_int, c_int, c_int, c_int, c_int, c_uint, c_uint, *const c_void);
    viewport = "glViewport" (c_int, c_int, c_int, c_int);
    clear_color = "glClearColor" (f32, f32, f32, f32);
    clear = "glClear" (c_uint);
    enable = "glEnable" (c_uint);
    disable = "glDisable" (c_uint);
    depth_function = "glDepthFunc" (c_uint);
    draw_elements = "glDrawElements" (c_uint, c_int, c_uint, *const c_void);
    read_pixels = "glReadPixels" (c_int, c_int, c_int, c_int, c_uint, c_uint, *mut c_void);
    finish = "glFinish" ();
}

/// An OpenGL context that draws to memory and is current on this thread.
pub struct Context {
    gl: Functions,
    /// OSMesa's own picture, which must exist as long as the context, although we draw elsewhere.
    _picture: RefCell<Box<[u32]>>,
    /// Keeps the context on its thread.
    _context: *mut c_void,
}

/// A picture to draw into.
pub struct Framebuffer {
    name: u32,
    size: (u32, u32),
}

/// A linked pair of shaders.
#[derive(Clone, Copy)]
pub struct Program {
    name: u32,
    tint: c_int,
}

/// A texture.
#[derive(Clone, Copy)]
pub struct TextureName(u32);

/// Buffers with vertices and indices.
pub struct Geometry {
    buffers: [u32; 2],
    count: usize,
}

/// A run of triangles with a material.
pub struct Part {
    buffers: [u32; 2],
    indices: Range<usize>,
    tint: [f32; 3],
    texture: Option<TextureName>,
    cull: bool,
}

impl Context {
    /// Loads the library and creates a context. Returns `None` if the library is not installed.
    pub fn open() -> Result<Option<Self>, String> {
        // Mesa's initializers have no requirements on the process. The handle is leaked, so nothing
        // is unloaded.
        let library = NAMES.iter().find_map(|name| unsafe { Library::new(*name) }.ok());
        let Some(library) = library else { return Ok(None) };
        let library: &'static Library = Box::leak(Box::new(library));
        let gl = Functions::load(library)?;
        let mut picture = vec![0_u32; 16 * 16].into_boxed_slice();
        // SAFETY: no context is shared (null); the picture holds 16 × 16 pixels of 4 bytes and
        // outlives the context.
        let context = unsafe {
            let context = (gl.create_context)(name::RGBA, 24, 0, 0, null_mut());
            let data = picture.as_mut_ptr().cast();
            let current = (gl.make_current)(context, data, name::UNSIGNED_BYTE, 16, 16);
            (current != 0).then_some(context)
        };
        let context = context.ok_or("OSMesa cannot create a context")?;
        Ok(Some(Self { gl, _picture: RefCell::new(picture), _context: context }))
    }

    /// Returns the name and version of the renderer.
    pub fn renderer(&self) -> String {
        let text = |which| {
            // SAFETY: the result is null or a static string that ends in 0.
            let text = unsafe { (self.gl.get_string)(which) };
            if text.is_null() {
                return String::new();
            }
            // SAFETY: as above.
            unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
        };
        format!("{}, {}", text(name::RENDERER), text(name::VERSION))
    }

    /// Creates a picture with 8-bit RGBA and 32-bit float depth.
    pub fn framebuffer(&self, size: (u32, u32), samples: u32) -> Result<Framebuffer, String> {
        let samples = if samples == 1 { 0 } else { samples as c_int };
        let mut framebuffer = 0;
        let attachments = [
            (name::COLOR_ATTACHMENT0, name::RGBA8),
            (name::DEPTH_ATTACHMENT, name::DEPTH_COMPONENT32F),
        ];
        // SAFETY: each generator writes one name; the other calls take only numbers.
        let status = unsafe {
            (self.gl.gen_framebuffers)(1, &mut framebuffer);
            (self.gl.bind_framebuffer)(name::FRAMEBUFFER, framebuffer);
            for (place, format) in attachments {
                let mut buffer = 0;
                let (width, height) = (size.0 as c_int, size.1 as c_int);
                (self.gl.gen_renderbuffers)(1, &mut buffer);
                (self.gl.bind_renderbuffer)(name::RENDERBUFFER, buffer);
                (self.gl.renderbuffer_storage)(name::RENDERBUFFER, samples, format, width, height);
                (self.gl.attach)(name::FRAMEBUFFER, place, name::RENDERBUFFER, buffer);
            }
            (self.gl.check_framebuffer)(name::FRAMEBUFFER)
        };
        let complete = status == name::FRAMEBUFFER_COMPLETE;
        let fault = || format!("cannot create a framebuffer with {samples} samples: {status:#x}");
        complete.then_some(Framebuffer { name: framebuffer, size }).ok_or_else(fault)
    }

    /// Copies vertices and indices into buffers.
    pub fn geometry(&self, vertices: &[Vertex], indices: &[u32]) -> Result<Geometry, String> {
        if indices.iter().any(|&index| index as usize >= vertices.len()) {
            return Err("an index is out of range".into());
        }
        let mut buffers = [0; 2];
        // SAFETY: two names are written to an array of two, and the data are slices passed with
        // their sizes.
        unsafe {
            (self.gl.gen_buffers)(2, buffers.as_mut_ptr());
            self.bind(buffers);
            let upload = |place, size: usize, data: *const c_void| {
                (self.gl.buffer_data)(place, size as isize, data, name::STATIC_DRAW);
            };
            upload(name::ARRAY_BUFFER, size_of_val(vertices), vertices.as_ptr().cast());
            upload(name::ELEMENT_ARRAY_BUFFER, size_of_val(indices), indices.as_ptr().cast());
        }
        Ok(Geometry { buffers, count: indices.len() })
    }

    /// Copies a texture, which is repeated and bilinear, without mip maps.
    pub fn texture(&self, texture: &Texture) -> Result<TextureName, String> {
        if texture.rgba.len() != texture.width * texture.height {
            return Err("incomplete texture".into());
        }
        let (width, height) = (texture.width as c_int, texture.height as c_int);
        let mut created = 0;
        // SAFETY: one name is written, and there are `width` × `height` texels of 4 bytes.
        unsafe {
            (self.gl.gen_textures)(1, &mut created);
            (self.gl.bind_texture)(name::TEXTURE_2D, created);
            for filter in [name::TEXTURE_MIN_FILTER, name::TEXTURE_MAG_FILTER] {
                (self.gl.texture_parameter)(name::TEXTURE_2D, filter, name::LINEAR);
            }
            let (data, format) = (texture.rgba.as_ptr().cast(), name::RGBA8 as c_int);
            let (rgba, byte) = (name::RGBA, name::UNSIGNED_BYTE);
            (self.gl.texture_image)(
                name::TEXTURE_2D,
                0,
                format,
                width,
                height,
                0,
                rgba,
                byte,
                data,
            );
        }
        Ok(TextureName(created))
    }

    /// Compiles and links shaders with the attributes `position`, `normal` and `uv` and the
    /// uniforms `world_to_clip` and `tint`.
    pub fn program(
        &self,
        vertex: &str,
        fragment: &str,
        matrix: [f32; 16],
    ) -> Result<Program, String> {
        let vertex = self.shader(name::VERTEX_SHADER, vertex)?;
        let fragment = self.shader(name::FRAGMENT_SHADER, fragment)?;
        // SAFETY: the strings end in 0, the matrix has 16 numbers, and one number is written to
        // `status`.
        unsafe {
            let program = (self.gl.create_program)();
            (self.gl.attach_shader)(program, vertex);
            (self.gl.attach_shader)(program, fragment);
            for (place, attribute) in (0..).zip([c"position", c"normal", c"uv"]) {
                (self.gl.bind_attribute)(program, place, attribute.as_ptr());
            }
            (self.gl.link)(program);
            let mut status = 0;
            (self.gl.program_status)(program, name::LINK_STATUS, &mut status);
            if status == 0 {
                return Err("cannot link a program".into());
            }
            (self.gl.use_program)(program);
            let place = (self.gl.uniform_location)(program, c"world_to_clip".as_ptr());
            (self.gl.uniform_mat4)(place, 1, 0, matrix.as_ptr());
            let tint = (self.gl.uniform_location)(program, c"tint".as_ptr());
            Ok(Program { name: program, tint })
        }
    }

    fn shader(&self, kind: u32, source: &str) -> Result<u32, String> {
        let text = CString::new(source).map_err(|error| error.to_string())?;
        let mut status = 0;
        // SAFETY: the only string ends in 0, so no lengths are needed, and one number is written to
        // `status`.
        let shader = unsafe {
            let shader = (self.gl.create_shader)(kind);
            (self.gl.shader_source)(shader, 1, &text.as_ptr(), null());
            (self.gl.compile)(shader);
            (self.gl.shader_status)(shader, name::COMPILE_STATUS, &mut status);
            shader
        };
        if status == 0 { Err(format!("cannot compile a shader:\n{source}")) } else { Ok(shader) }
    }

    /// Begins a frame: clears color and depth.
    pub fn begin(&self, target: &Framebuffer) {
        let (width, height) = (target.size.0 as c_int, target.size.1 as c_int);
        // SAFETY: the arguments are only numbers.
        unsafe {
            (self.gl.bind_framebuffer)(name::FRAMEBUFFER, target.name);
            (self.gl.viewport)(0, 0, width, height);
            (self.gl.enable)(name::DEPTH_TEST);
            (self.gl.depth_function)(name::LESS);
            (self.gl.clear_color)(0.0, 0.0, 0.0, 0.0);
            (self.gl.clear)(name::COLOR_AND_DEPTH);
        }
    }

    /// Draws a part.
    pub fn draw(&self, program: Program, part: &Part) {
        let [r, g, b] = part.tint;
        let (stride, float) = (size_of::<Vertex>() as c_int, name::FLOAT);
        let offset = |bytes: usize| null::<u8>().wrapping_add(bytes).cast::<c_void>();
        let (first, count) = (part.indices.start * 4, part.indices.len() as c_int);
        // SAFETY: with buffers bound, pointers are offsets into them; the attributes are the fields
        // of `Vertex`, the index range is valid (`Geometry::part`), and so are the indices
        // (`geometry`).
        unsafe {
            let switch = if part.cull { self.gl.enable } else { self.gl.disable };
            switch(name::CULL_FACE);
            (self.gl.use_program)(program.name);
            (self.gl.uniform_vec3)(program.tint, r, g, b);
            if let Some(TextureName(texture)) = part.texture {
                (self.gl.bind_texture)(name::TEXTURE_2D, texture);
            }
            self.bind(part.buffers);
            for (place, numbers, start) in [(0, 3, 0), (1, 3, 12), (2, 2, 24)] {
                (self.gl.enable_attribute)(place);
                (self.gl.attribute)(place, numbers, float, 0, stride, offset(start));
            }
            (self.gl.draw_elements)(name::TRIANGLES, count, name::UNSIGNED_INT, offset(first));
        }
    }

    fn bind(&self, [vertices, indices]: [u32; 2]) {
        // SAFETY: the arguments are only numbers.
        unsafe {
            (self.gl.bind_buffer)(name::ARRAY_BUFFER, vertices);
            (self.gl.bind_buffer)(name::ELEMENT_ARRAY_BUFFER, indices);
        }
    }

    /// Averages the samples of each pixel into another picture of the same size.
    pub fn resolve(&self, from: &Framebuffer, to: &Framebuffer) {
        let (w, h) = (to.size.0 as c_int, to.size.1 as c_int);
        // SAFETY: the arguments are only numbers.
        unsafe {
            (self.gl.bind_framebuffer)(name::READ_FRAMEBUFFER, from.name);
            (self.gl.bind_framebuffer)(name::DRAW_FRAMEBUFFER, to.name);
            (self.gl.blit)(0, 0, w, h, 0, 0, w, h, name::COLOR, name::NEAREST);
        }
    }

    /// Waits until everything is drawn.
    pub fn finish(&self) {
        // SAFETY: there are no arguments.
        unsafe { (self.gl.finish)() }
    }

    /// Returns the pixels of a picture with one sample, in rows from the top.
    pub fn read(&self, from: &Framebuffer) -> Vec<[u8; 4]> {
        let (width, height) = from.size;
        let mut pixels = vec![[0_u8; 4]; width as usize * height as usize];
        let data = pixels.as_mut_ptr().cast();
        let (w, h) = (width as c_int, height as c_int);
        // SAFETY: `width` × `height` pixels of 4 bytes are written, which is the size of the
        // vector; rows of 4-byte pixels need no padding.
        unsafe {
            (self.gl.bind_framebuffer)(name::FRAMEBUFFER, from.name);
            (self.gl.read_pixels)(0, 0, w, h, name::RGBA, name::UNSIGNED_BYTE, data);
        }
        // OpenGL's rows run from the bottom up.
        pixels.chunks(width as usize).rev().flatten().copied().collect()
    }
}

impl Geometry {
    /// Returns the triangles of a range of indices.
    pub fn part(
        &self,
        indices: Range<usize>,
        tint: [f32; 3],
        texture: Option<TextureName>,
        cull: bool,
    ) -> Result<Part, String> {
        if indices.start > indices.end || indices.end > self.count {
            return Err("a part is out of range".into());
        }
        Ok(Part { buffers: self.buffers, indices, tint, texture, cull })
    }
}
