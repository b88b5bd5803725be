//! Plots a mesh in HP-GL with hidden lines removed, and reports progress.

use camera::{
    Camera, ViewProjection,
    homog::{Affine, Point, Vector},
};
use hidden_line::{DrawOptions, Monitor, Subject, Workers, draw};
use model::{Mesh, Model, ModelInstance, Node, Primitive};
use projection::{Convention, Orthographic};
use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

#[derive(Debug, Default)]
struct Progress(AtomicU64);

impl Monitor for Progress {
    fn report_progress(&self, done: u64, total: u64) {
        self.0.fetch_max(100 * done / total, Ordering::Relaxed);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A cube with three visible faces has nine visible and three hidden edges.
    let positions: Vec<[f32; 3]> =
        (0..8).map(|bits| [0, 1, 2].map(|axis| (bits >> axis & 1) as f32)).collect();
    let indices = [
        0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6,
        1, 3, 5, 3, 7, 5,
    ];
    let primitive = Primitive { positions, indices: indices.to_vec(), ..Primitive::default() };
    let model = Arc::new(Model {
        meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        ..Model::default()
    });
    let camera = Camera::look_at(Point::new(3.0, 2.5, 4.0), Point::new(0.5, 0.5, 0.5), Vector::Y)?;
    let view_to_clip =
        Orthographic::new(-1.2, 1.2, -0.9, 0.9, 0.1, 20.0)?.view_to_clip(Convention::CHAPTER);
    let subject = Subject {
        models: &[ModelInstance { model, model_to_world: Affine::IDENTITY }],
        view_projection: ViewProjection { camera, view_to_clip },
        size: [1200, 900],
        caption_height: 0,
        sections: &[],
        uncut: &[],
    };
    let progress = Progress::default();
    let drawing =
        draw(&subject, &DrawOptions::hidden_edges_retained(), Workers::monitored(2, &progress))?;
    let [mut seen, mut hidden] = [0, 0];
    let mut hpgl = String::from("IN;SP1;");
    for segment in &drawing.segments {
        *(if segment.visible { &mut seen } else { &mut hidden }) += 1;
        if segment.visible {
            let [a, b] = segment.ends.map(|end| (end.x * 10.0, 9000.0 - end.y * 10.0));
            hpgl += &format!("PU{:.0},{:.0};PD{:.0},{:.0};", a.0, a.1, b.0, b.1);
        }
    }
    println!("{hpgl}\n{seen} seen, {hidden} hidden");
    assert_eq!((seen, hidden, progress.0.into_inner()), (9, 3, 100));
    Ok(())
}
