//! A textured mesh of 100,352 triangles: a bumpy sheet in front of the eye, or hills below it that
//! extend to the horizon.

pub const SIZE: (u32, u32) = (640, 480);
const SIDE: u32 = 224;

pub struct Scene {
    pub positions: Vec<[f32; 3]>,
    pub uvs: Vec<[f32; 2]>,
    pub triangles: Vec<[u32; 3]>,
    /// OpenGL's matrix, column by column.
    pub to_clip: [f32; 16],
    texels: Vec<[u8; 3]>,
}

impl Scene {
    pub fn new(is_sheet: bool) -> Self {
        let (mut positions, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for (row, column) in (0..=SIDE).flat_map(|row| (0..=SIDE).map(move |column| (row, column)))
        {
            let [u, v] = [column, row].map(|at| at as f32 / SIDE as f32);
            let bump = 0.3 * (20.0 * u).sin() * (17.0 * v).cos();
            positions.push(match is_sheet {
                true => [5.0 * u - 2.5, 4.0 * v - 2.0, bump - 3.0],
                false => [30.0 * u - 15.0, bump - 1.5, -40.0 * v - 2.0],
            });
            uvs.push([u, v]);
            let at = row * (SIDE + 1) + column;
            if row < SIDE && column < SIDE {
                triangles.push([at, at + 1, at + SIDE + 2]);
                triangles.push([at, at + SIDE + 2, at + SIDE + 1]);
            }
        }
        let (near, far) = (0.1, 100.0);
        let to_clip = [
            1.5,
            0.0,
            0.0,
            0.0, //
            0.0,
            2.0,
            0.0,
            0.0, //
            0.0,
            0.0,
            -(far + near) / (far - near),
            -1.0, //
            0.0,
            0.0,
            -2.0 * far * near / (far - near),
            0.0,
        ];
        let texel =
            |at: u32| [at as u8, (at >> 8) as u8, if (at ^ at >> 8) & 16 == 0 { 200 } else { 60 }];
        Self { positions, uvs, triangles, to_clip, texels: (0..1 << 16).map(texel).collect() }
    }

    /// Returns the nearest texel.
    #[inline(always)]
    pub fn texel(&self, u: f32, v: f32) -> [u8; 3] {
        let [x, y] = [u, v].map(|at| ((at * 256.0) as usize).min(255));
        self.texels[y << 8 | x]
    }
}
