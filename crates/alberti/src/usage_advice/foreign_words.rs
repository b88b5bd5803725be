//! Words that people bring from f3d, Blender, ImageMagick, ffmpeg, three.js or stl-thumb.

/// Flags of other programs: their names without hyphens at the front; a flag that the command must
/// have; and what to write.
///
/// Of several rows with a name the first counts whose flag the command has. A row without a flag
/// holds for every command that draws, since it names another one. Single letters keep their case.
pub(super) const FOREIGN_FLAGS: &[(&str, &str, &str)] = &[
    (
        "resolution res dim dims dimensions image-size img-size imgsize geometry resize thumbnail width height \
         resolution-x resolution-y W H",
        "size",
        "--size 1920x1080",
    ),
    (
        "bg bgcolor bg-color background-color back-color clear-color",
        "background",
        "--background '#f4f1ea'",
    ),
    (
        "no-background transparent film-transparent transparency",
        "background",
        "--background transparent",
    ),
    (
        "background-hdri hdri-background skybox hdri-skybox",
        "background",
        "--background environment",
    ),
    ("wireframe wire", "style", "--style wireframe"),
    ("toon cel cartoon", "style", "--style toon"),
    ("line-art lineart hidden-line hidden-lines freestyle", "style", "--style lines"),
    ("flat flat-shading", "style", "--style flat"),
    ("texture-matcap", "style", "--style matcap"),
    ("shading render-mode mode", "style", "--style shaded"),
    (
        "hdri hdr hdri-file hdri-filename env-map envmap environment-map ibl world",
        "environment",
        "--environment studio.hdr",
    ),
    (
        "hdri-rotation hdri-angle environment-angle",
        "environment-rotation",
        "--environment-rotation 90",
    ),
    ("light lights brightness light-strength key-light", "light-intensity", "--light-intensity 2"),
    (
        "ortho orthographic orthogonal parallel camera-orthographic",
        "projection",
        "--projection orthographic",
    ),
    ("perspective persp", "projection", "--projection perspective"),
    ("isometric iso", "projection", "--projection isometric"),
    ("yaw rotate-y camera-azimuth camera-azimuth-angle", "azimuth", "--azimuth 30"),
    ("pitch rotate-x camera-elevation camera-elevation-angle", "elevation", "--elevation 20"),
    ("fovy field-of-view view-angle camera-fov camera-view-angle", "fov", "--fov 35"),
    ("camera-zoom camera-zoom-factor zoom-factor", "zoom", "--zoom 1.5"),
    ("position camera-position camera-pos eye-position from", "eye", "--eye 4,3,6 --target 0,0,0"),
    (
        "look-at lookat focal-point camera-focal-point center",
        "target",
        "--target 0,0,0 --eye 4,3,6",
    ),
    ("camera-view-up camera-up viewup", "view-up", "--view-up 0,1,0 --eye 4,3,6 --target 0,0,0"),
    ("camera-index", "camera", "--camera 0"),
    ("q ao ssao", "ambient-occlusion", "--ambient-occlusion"),
    (
        "antialias antialiasing anti-alias anti-aliasing msaa aa spp raytracing-samples \
         cycles-samples eevee-samples render-samples",
        "samples",
        "--samples 8",
    ),
    ("tonemap tonemapping view-transform display-transform", "tone-mapping", "--tone-mapping aces"),
    ("shadow cast-shadows", "shadows", "--shadows on"),
    ("no-shadow no-shadows", "shadows", "--shadows off"),
    ("smooth shade-smooth smooth-shading auto-smooth crease-angle", "crease", "--crease 30"),
    ("floor ground-plane shadow-catcher", "ground", "--ground shadow"),
    ("axis axes", "overlay", "--overlay axes"),
    ("g grid", "overlay", "--overlay grid"),
    ("clip cut slice clipping-plane cross-section", "section", "--section x=0"),
    ("up-axis z-up zup", "up", "--up z"),
    ("size-px", "size", "--size 1920x1080"),
    ("supersample supersampling resolution-percentage", "scale", "--scale 2"),
    ("depth bit-depth color-depth", "bits", "--bits 16"),
    ("units", "unit", "--unit mm"),
    ("pointsize point-sprites point-radius", "point-size", "--point-size 5"),
    (
        "scalar scalar-coloring coloring coloring-array color-by colorby attribute vertex-attribute",
        "scalars",
        "--scalars temperature",
    ),
    ("cmap color-map colour-map colormap-file lut palette", "colormap", "--colormap turbo"),
    ("clim crange coloring-range range color-range", "scalar-range", "--scalar-range 0,100"),
    ("animation-time ss", "time", "--time 1.5"),
    ("animation-index animation-indices animation-name", "animation", "--animation 0"),
    ("frame-rate framerate animation-frame-rate r", "fps", "--fps 30"),
    ("frame-count num-frames frames:v vframes", "frames", "--frames 60"),
    ("o output out outdir output-dir output-folder", "out-dir", "--out-dir pictures"),
    (
        "out outfile out-file output-file screenshot-filename save export image write",
        "output",
        "--output picture.png",
    ),
    ("paper-size page page-size", "paper", "--paper a4"),
    ("jobs cores num-threads nthreads j", "threads", "--threads 4"),
    ("reference ref baseline diff", "compare", "--compare reference.png"),
    ("ref-threshold threshold", "tolerance", "--tolerance 2 --compare reference.png"),
    ("qscale:v q:v", "quality", "--quality 85"),
    ("S scene-name scene-index", "scene", "--scene 0"),
    ("turntable orbit spin animate", "", "alberti animate model.glb --turntable -o turn.gif"),
];

/// Flags of other programs that have no counterpart, or several: their names, the only command for
/// which it holds if there is one, and what to do.
pub(super) const FOREIGN_HABITS: &[(&str, &str, &str)] = &[
    ("b", "", "nothing opens a window here, so leave it out"),
    (
        "y overwrite overwrite-output",
        "",
        "existing files are overwritten without asking once the new ones are complete, so leave it out",
    ),
    (
        "s size",
        "thumbnailer",
        "`alberti thumbnailer model.glb thumb.png --size 128` gives the side in pixels",
    ),
    (
        "i input in file filename o output",
        "thumbnailer",
        "neither file needs a flag, as in `alberti thumbnailer model.glb thumb.png`",
    ),
    (
        "size s resolution res width height",
        "sheet",
        "`--paper a4` gives the size of the page, and `--dpi 300` the pixels of a PNG",
    ),
    (
        "outdir output-dir out-dir output-folder",
        "render",
        "a template names the outputs, as in `-o 'pictures/{stem}.png'`",
    ),
    (
        "i input in file filename",
        "animate",
        "the input needs no flag, as in `alberti animate model.glb -o film.gif`",
    ),
    (
        "i input in file filename",
        "",
        "the input needs no flag, as in `alberti render model.glb -o picture.png`",
    ),
    (
        "P python python-expr python-text",
        "",
        "no scripts are run; `alberti scene init model.glb` creates a scene file to edit instead",
    ),
    (
        "s e frame-start frame-end start-frame end-frame start end to-frame",
        "animate",
        "times are in seconds, as in `--from 0 --to 2.5`, and `--frames 10` is the number of frames",
    ),
    (
        "f frame render-frame",
        "",
        "`alberti render model.glb` draws one picture without it; for another moment of an animation \
         use `--time 1.5`, in seconds",
    ),
    (
        "frames frame-start frame-end start-frame end-frame fps framerate frame-rate r delay loop \
         duration no-loop",
        "render",
        "this command draws one moment; run `alberti animate model.glb -o film.gif` for more",
    ),
    ("a render-anim", "", "`alberti animate model.glb -o film.gif` renders a whole animation"),
    (
        "E engine renderer cycles-device device gpu cuda opencl raytracing raytrace ray-tracing \
         path-tracing pathtracing denoise denoiser",
        "",
        "there is one renderer, on the CPU and without ray tracing; `--samples 16` smooths edges",
    ),
    (
        "F render-format output-format image-format",
        "render",
        "`--format png` chooses the format, and so does the ending of the output file, as in \
         `-o picture.jpg`",
    ),
    (
        "F render-format output-format image-format format",
        "",
        "the ending of the output file chooses the format, as in `-o film.gif`",
    ),
    (
        "render-output",
        "",
        "`-o 'pictures/{stem}.png'` names the output, and `{frame:04}` in it is the number of a frame",
    ),
    (
        "vf filter:v filter-complex",
        "",
        "`--size 320x240` gives the size of pictures; for other filters give them to ffmpeg",
    ),
    (
        "x use-extension",
        "",
        "the ending of the output file decides the format, as in `-o picture.png`: leave it out",
    ),
    (
        "t",
        "",
        "`--threads 4` is the number of threads, and `--tone-mapping aces` chooses the tone curve",
    ),
    (
        "e edges show-edges",
        "",
        "`--style wireframe` shows all edges of the mesh, and `--overlay edges` draws outlines and \
         creases over the picture",
    ),
    (
        "camera-direction direction viewpoint",
        "",
        "a direction is given as `--azimuth 30 --elevation 20`, or by `--eye 4,3,6 --target 0,0,0`",
    ),
    (
        "roll camera-roll camera-roll-angle",
        "",
        "`--view-up 0,1,0`, beside `--eye 4,3,6 --target 0,0,0`, says what is up in the picture",
    ),
    (
        "hdri-ambient",
        "",
        "leave it out: an environment file, as in `--environment studio.hdr`, lights the model as well",
    ),
    (
        "dpi density",
        "",
        "`--size 1920x1080` gives the pixels; `alberti sheet model.glb --dpi 300 -o sheet.png` draws \
         on paper, to scale",
    ),
    (
        "s",
        "",
        "`--size 1920x1080` gives the pixels, and `--scalars temperature` colors by an attribute",
    ),
    (
        "tile montage contact-sheet",
        "",
        "`alberti batch models --out-dir pictures` writes a contact sheet beside its pictures",
    ),
    (
        "verbose v vv vvv debug debug-all log log-level loglevel",
        "render",
        "`--timings` prints the time of each stage, and `--json` a report",
    ),
    (
        "verbose v vv vvv debug debug-all log log-level loglevel quiet silent hide-banner nostats",
        "",
        "only warnings and errors are printed; leave it out",
    ),
    (
        "texture textures texture-path texture-file opacity metallic roughness base-color emissive-factor normal-scale texture-base-color \
         texture-normal texture-material texture-emissive material materials",
        "",
        "materials come from the file; `alberti scene init model.glb` creates a scene file, which can \
         replace them",
    ),
    (
        "bar scalar-bar coloring-scalar-bar legend colorbar",
        "",
        "there is no color bar; `--scalar-range 0,100` says what the ends of the colormap stand for",
    ),
    (
        "line-width linewidth edge-width stroke-width strokewidth edge-color line-color stroke fill",
        "",
        "a scene file sets the pens of lines; `alberti scene doc` lists them",
    ),
    (
        "c:v vcodec codec:v codec pix-fmt crf b:v bitrate preset an movflags",
        "",
        "ffmpeg makes the video: `alberti animate model.glb -o film.mp4` says how to pipe frames to it",
    ),
    (
        "delay speed animation-speed-factor step frame-step frame-jump",
        "animate",
        "`--fps 30` gives the speed, and `--frames 10` the number of frames",
    ),
    (
        "duration length seconds",
        "animate",
        "`--from 0 --to 2.5` gives the part of an animation, in seconds; a turntable takes as long as \
         `--frames 60` at `--fps 30`",
    ),
    (
        "angle degrees sweep",
        "animate",
        "a turntable turns by an angle in degrees: `alberti animate model.glb --turntable=180 -o turn.gif`",
    ),
    ("flatten", "", "`--background white` fills what the model leaves empty"),
    (
        "alpha",
        "",
        "`--background transparent` keeps the alpha channel, and `--background white` fills it",
    ),
    ("max-size", "", "`--max-file-bytes 100MiB` is the largest file that is read"),
    (
        "focal-length focal lens lens-mm sensor-width sensor-height sensor-size",
        "",
        "`--fov 27` is the vertical angle of view in degrees: that of a 50 mm lens on full frame",
    ),
    (
        "dof depth-of-field aperture f-stop fstop focus-distance focal-distance motion-blur bloom glow \
         fog mist volumetrics caustics ssr reflections",
        "",
        "effects such as blur, glow and fog are not rendered, so leave it out",
    ),
    (
        "near far znear zfar near-plane far-plane clip-start clip-end clipping-range",
        "",
        "the near and far planes are placed around the model; a scene file can set them, and \
         `alberti scene doc Perspective` says how",
    ),
    (
        "sun sun-direction sun-angle light-direction light-position light-color light-dir",
        "",
        "`--light-intensity 2` makes the lights stronger; a scene file places them, and \
         `alberti scene doc Light` says how",
    ),
    (
        "subdivide subdivision subdivision-level bevel modifier decimate simplify remesh merge weld \
         triangulate center-model normalize-scale fit-to-unit",
        "",
        "models are drawn as they are; change them in another program, such as Blender",
    ),
    (
        "translate translation rotate-x rotate-z scale-model object-rotation model-rotation rotation",
        "",
        "`--azimuth 30` and `--elevation 20` turn the view; to move or turn a model use a scene file, \
         which `alberti scene init model.glb` creates",
    ),
    (
        "gamma color-management colorspace-out color-space ocio brightness-contrast contrast saturation",
        "",
        "pictures are in sRGB; `--exposure 1` makes them brighter, and `--tone-mapping aces` sets the \
         tone curve",
    ),
    (
        "hide-ground no-ground no-floor hide-floor",
        "",
        "there is no ground unless `--ground shadow` asks for one, so leave it out",
    ),
    (
        "collection object objects node nodes part parts only hide exclude include show select layer \
         view-layer mesh-index",
        "render",
        "the whole scene of the file is drawn; `--scene 0` chooses one of its scenes by index or name",
    ),
    (
        "views view",
        "sheet",
        "a scene file chooses the views of a sheet, and `alberti scene doc SheetView` says how",
    ),
    (
        "host bind address listen ip interface",
        "explore",
        "the page is served to this machine only, at 127.0.0.1; to see it from another one forward \
         the port with `ssh -L`",
    ),
    ("browser", "explore", "`--open` opens the page in the browser"),
    (
        "no-browser no-open headless",
        "explore",
        "no browser is opened unless `--open` asks for it, so leave it out",
    ),
    (
        "headless offscreen no-gui nogui no-window background-mode no-render-window",
        "",
        "nothing opens a window here, so leave it out",
    ),
    (
        "help-all",
        "",
        "`alberti --help` lists the commands, and `alberti reference` prints all flags",
    ),
    ("version", "", "run `alberti --version`"),
    ("progress animation-progress", "", "a terminal shows the progress by itself, so leave it out"),
    (
        "recursive multi-file-mode",
        "",
        "`alberti batch models --out-dir pictures` draws every model in a folder",
    ),
    (
        "axes-grid grid-absolute grid-unit grid-subdivisions grid-color",
        "",
        "`--overlay grid` draws a grid, whose spacing a scene file can set",
    ),
    ("metadata", "", "`alberti info model.glb` lists what a file contains"),
    ("armature skeleton bones", "", "skeletons are not drawn"),
    ("backface-type culling cull", "", "the materials of the file say which faces have two sides"),
    (
        "blur-background blur-coc",
        "",
        "`--background environment` shows the environment sharp, and a scene file can blur it",
    ),
    (
        "coloring-component coloring-by-cells colormap-discretization",
        "",
        "`--scalars temperature` colors by one attribute of the vertices; there is nothing more to set",
    ),
    (
        "loop no-loop",
        "",
        "a film begins again by itself in `-o film.gif` and `-o film.png`: leave it out",
    ),
    (
        "rotate flip flop trim blur strip border gravity extent colorspace negate level \
         sharpen unsharp sepia-tone monochrome grayscale colors dither quantize composite append \
         annotate draw label font shave splice chop distort repage adjoin compress interlace fuzz \
         opaque modulate normalize equalize edge emboss charcoal posterize mattecolor bordercolor \
         sample page type layers dispose coalesce set interpolate filter define monitor reverse",
        "",
        "pictures are not edited here; give the result to ImageMagick",
    ),
    (
        "factory-startup noaudio no-audio setaudio enable-autoexec disable-autoexec addons no-window-focus \
         window-geometry no-native-pixels python-exit-code disable-crash-handler env-system-datafiles \
         no-render rendering-backend trackball invert-zoom interaction-test-play \
         interaction-test-record interaction-style list-bindings bindings-list cheatsheet font-file \
         font-scale load-plugins list-rendering-backends force-reader textures-transform base-ior \
         final-shader display-depth blending animation-autoplay window-border",
        "",
        "it has no counterpart here, so leave it out",
    ),
    (
        "depth-peeling translucency translucency-support depth-sorting",
        "",
        "transparent surfaces are always sorted, so leave it out",
    ),
    (
        "config",
        "",
        "settings are read only from a scene file; `alberti scene init model.glb` creates one",
    ),
    (
        "volume volume-rendering volume-opacity-file volume-opacity-map volume-inverse inverse",
        "",
        "volumes are not drawn",
    ),
    (
        "readers-list list-readers list-formats formats readers",
        "",
        "`alberti render --help` names the formats of models",
    ),
    ("dry-run", "", "`alberti check model.glb` reads a model and draws nothing"),
];

/// Values of other programs: the flag, their names, and the value here.
pub(super) const FOREIGN_VALUES: &[(&str, &str, &str)] = &[
    ("style", "cel cel-shaded cel-shading celshading cartoon comic anime", "toon"),
    ("style", "wire wires mesh", "wireframe"),
    ("style", "phong pbr rendered lit solid smooth realistic material textured", "shaded"),
    (
        "style",
        "line line-art lineart edges hidden-line hidden-lines hlr drawing ink freestyle",
        "lines",
    ),
    ("style", "normal normal-map", "normals"),
    ("style", "id object-id segmentation mask", "ids"),
    ("style", "xray ghost transparent glass", "x-ray"),
    ("style", "z zbuffer z-buffer depth-map", "depth"),
    ("style", "uvs checker checkerboard", "uv"),
    ("style", "pencil hand-drawn", "sketch"),
    ("style", "flat-shading faceted facetted low-poly", "flat"),
    ("projection", "ortho orthogonal parallel", "orthographic"),
    ("projection", "persp", "perspective"),
    ("projection", "iso", "isometric"),
    ("view", "behind rear", "back"),
    ("view", "side", "right"),
    ("view", "above plan", "top"),
    ("view", "below under", "bottom"),
    ("view", "3d perspective angled corner threequarter 3/4", "three-quarter"),
    ("tone-mapping", "filmic aces-filmic hill", "aces"),
    ("tone-mapping", "linear off raw standard", "none"),
    ("tone-mapping", "khronos pbr-neutral khronos-pbr-neutral", "neutral"),
    ("samples", "2 3 4x 4xmsaa", "4"),
    ("samples", "5 6 7 8x 8xmsaa", "8"),
    ("samples", "9 10 12 16x 32 64 100 128 256 512 1024 2048 4096", "16"),
    ("size", "720p hd", "1280x720"),
    ("size", "1080p 1080 fullhd full-hd fhd", "1920x1080"),
    ("size", "1440p qhd", "2560x1440"),
    ("size", "4k 2160p uhd", "3840x2160"),
    ("shadows", "true yes 1 enabled", "on"),
    ("shadows", "false no 0 none disabled", "off"),
    ("ground", "off no false", "none"),
    ("ground", "on yes true shadow-catcher catcher", "shadow"),
    ("unit", "meter meters metre metres", "m"),
    ("unit", "millimeter millimeters millimetre millimetres", "mm"),
    ("unit", "centimeter centimeters centimetre centimetres", "cm"),
    ("unit", "micron microns micrometer micrometre", "um"),
    ("unit", "inch inches", "in"),
    ("unit", "foot feet", "ft"),
    ("environment", "hdri sunset outdoor day daylight", "sky"),
    ("environment", "indoor neutral room softbox", "studio"),
    ("environment", "off no false black", "none"),
    ("colormap", "rainbow jet", "turbo"),
    ("colormap", "gray grey greyscale grays greys", "grayscale"),
    ("colormap", "plasma magma hot", "inferno"),
    ("colormap", "coolwarm rdbu bwr diverging", "cool-warm"),
    ("up", "+x", "x"),
    ("up", "+y", "y"),
    ("up", "+z", "z"),
];

/// Commands of other programs: their names, the command before them, and what to write.
pub(super) const FOREIGN_COMMANDS: &[(&str, &str, &str)] = &[
    (
        "view show open display preview",
        "alberti",
        "to look at a model run `alberti explore model.glb`; to make a picture, `alberti render model.glb`",
    ),
    ("thumbnail thumb", "alberti", "run `alberti render model.glb --size 256x256 -o thumb.png`"),
    (
        "turntable spin video film movie",
        "alberti",
        "run `alberti animate model.glb --turntable -o turn.gif`",
    ),
    (
        "draw drawing lines",
        "alberti",
        "run `alberti render model.glb --style lines -o drawing.svg`, or `alberti sheet model.glb` for views to scale",
    ),
    ("validate lint verify", "alberti", "run `alberti check model.glb`"),
    ("inspect stat stats identify", "alberti", "run `alberti info model.glb`"),
    (
        "convert export magick",
        "alberti",
        "to make a picture run `alberti render model.glb -o picture.png`; models are not converted: use another program for that, such as Blender",
    ),
    (
        "montage mogrify composite",
        "alberti",
        "to make pictures of many models run `alberti batch models --out-dir pictures`",
    ),
    ("init new", "alberti", "run `alberti scene init model.glb`"),
    (
        "compare diff",
        "alberti",
        "`alberti render model.glb --compare reference.png` compares a new picture with one in a file; for two pictures use ImageMagick: `magick compare a.png b.png difference.png`",
    ),
    (
        "serve server web",
        "alberti",
        "run `alberti explore model.glb`, which serves a page on this machine",
    ),
    ("formats list list-formats", "alberti", "`alberti render --help` names the formats of models"),
    ("version", "alberti", "run `alberti --version`"),
    ("matrices transform projection", "alberti", "run `alberti matrix`"),
    ("formula formulas equations", "alberti", "run `alberti reference formulas`"),
    ("quit exit", "alberti", "each command ends by itself"),
    ("validate lint verify", "scene", "run `alberti scene check scene.ron`"),
    ("format", "scene", "run `alberti scene fmt scene.ron`"),
    ("new create make", "scene", "run `alberti scene init model.glb`"),
    ("show reference docs fields", "scene", "run `alberti scene doc`"),
    ("render draw", "scene", "run `alberti render scene.ron`"),
    ("explore view open", "scene", "run `alberti render scene.ron`"),
];
