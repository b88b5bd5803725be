//! Converts one lens to the matrices of four interfaces, with the types of two other libraries and
//! an older glam.

use homog::{Affine, Clip, Point, Projective, View, World};
use projection::{Convention, Decomposed, Fov, Intrinsics, Perspective, decompose};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lens = Perspective::new(Fov::vertical_degrees(60.0), 1.5, 0.1, 100.0)?;

    // Convert to glam 0.30 through mint, and to nalgebra. Both provide OpenGL's perspective matrix.
    let ours = lens.view_to_clip(Convention::OPENGL);
    let in_glam: glam::DMat4 = mint_of(ours).into();
    let theirs = glam::DMat4::perspective_rh_gl(60_f64.to_radians(), 1.5, 0.1, 100.0);
    assert!(in_glam.abs_diff_eq(theirs, 1e-12));
    let in_nalgebra: nalgebra::Matrix4<f64> = ours.into();
    let theirs = nalgebra::Perspective3::new(1.5, 60_f64.to_radians(), 0.1, 100.0);
    assert!((in_nalgebra - theirs.to_homogeneous()).norm() < 1e-12);

    // Convert their matrix to ours, and to another interface.
    let ours = Projective::<View, Clip>::from(theirs);
    let vulkan = Convention::OPENGL.convert(Convention::VULKAN, ours);
    for (a, b) in vulkan
        .to_column_major()
        .into_iter()
        .zip(lens.view_to_clip(Convention::VULKAN).to_column_major())
    {
        assert!((a - b).abs() < 1e-12);
    }
    let Decomposed::Frustum(found) = decompose(vulkan, Convention::VULKAN)?.kind else {
        return Err("no frustum".into());
    };
    println!("near {:.6}, far {:.6}", found.near(), found.far());
    assert!((found.near() - 0.1).abs() < 1e-9 && (found.far() - 100.0).abs() < 1e-6);

    // Single precision for Direct3D shaders, and OpenCV's intrinsics.
    let columns: [f32; 16] = lens.view_to_clip(Convention::DIRECT3D).to_column_major_f32();
    assert_eq!(columns[11], 1.0, "w is the distance ahead");
    let k = Intrinsics::from_frustum(lens.to_frustum(), [1920, 1280])?;
    let [[fx, _, cx], ..] = k.to_rows();
    assert!((fx - 640.0 / 30_f64.to_radians().tan()).abs() < 1e-9 && cx == 960.0, "{fx} {cx}");

    // A nalgebra pose, and a point through the whole chain.
    let pose = nalgebra::Isometry3::new(
        nalgebra::Vector3::new(0.0, 0.0, -5.0),
        nalgebra::Vector3::y() * 0.5,
    );
    let world_to_view = Affine::<World, View>::from(pose);
    let p = Point::<World>::new(0.3, 0.4, 0.5);
    let seen: nalgebra::Point3<f64> = (world_to_view * p).into();
    assert!((seen - pose * nalgebra::Point3::new(0.3, 0.4, 0.5)).norm() < 1e-12);

    // Any serde format works.
    let text = serde_json::to_string(&(p, world_to_view))?;
    let back: (Point<World>, Affine<World, View>) = serde_json::from_str(&text)?;
    assert_eq!(back, (p, world_to_view));
    assert!(
        serde_json::from_str::<Affine<World, View>>("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]")
            .is_err()
    );
    Ok(())
}

/// Converts column by column, through the mint version that both support.
fn mint_of(map: Projective<View, Clip>) -> glam_mint::ColumnMatrix4<f64> {
    map.into()
}

use mint as glam_mint;
