//! A picture server: a client that disconnects cancels its rendering, while a second client is
//! answered.

use pipeline::scene::file::{CameraFile, LightFile};
use pipeline::{
    CancelToken, Monitor, Picture, RenderContext, RenderError, Renderer, Scene, Textures,
};
use std::io::{Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, mpsc};
use std::time::Duration;

fn answer(mut client: TcpStream) -> Result<String, Box<dyn std::error::Error>> {
    let mut request = [0; 256];
    let count = client.read(&mut request)?;
    let side: u32 = String::from_utf8_lossy(&request[..count]).trim().parse()?;
    let scene = Scene::builder()
        .mesh([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]], [0, 1, 2])
        .camera(CameraFile::look_at([0.0, 0.0, 4.0], [0.0; 3]))
        .light(LightFile::directional([0.0, 0.0, -1.0], 2.0)?)
        .size(side, side)
        .build()?;
    let cancel = CancelToken::default();
    // A thread waits until the connection is closed.
    let (mut watched, canceling) = (client.try_clone()?, cancel.clone());
    std::thread::spawn(move || {
        if watched.read(&mut [0; 1]).unwrap_or(0) == 0 {
            canceling.cancel();
        }
    });
    let monitor: Arc<dyn Monitor> = Arc::new(cancel);
    let textures = Textures::for_scene(&scene);
    let context = RenderContext::new(&scene, &textures, 1).with_monitor(&monitor);
    let mut picture = Picture::<u8>::default();
    match Renderer::default().render(&context, &mut picture) {
        Ok(_) => client.write_all(&picture.to_png())?,
        Err(RenderError::Canceled) => return Ok(format!("{side}: canceled")),
        Err(error) => return Err(error.into()),
    }
    Ok(format!("{side}: sent"))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let listener = TcpListener::bind(("127.0.0.1", 0))?;
    let address = listener.local_addr()?;
    let (done, outcomes) = mpsc::channel();
    std::thread::spawn(move || {
        for client in listener.incoming().flatten() {
            let done = done.clone();
            std::thread::spawn(move || {
                done.send(answer(client).unwrap_or_else(|error| error.to_string()))
            });
        }
    });
    // One client requests a huge picture and disconnects; another requests a small picture and
    // waits for it.
    let mut impatient = TcpStream::connect(address)?;
    impatient.write_all(b"12000\n")?;
    let mut patient = TcpStream::connect(address)?;
    patient.write_all(b"64\n")?;
    let mut png = [0; 8];
    patient.read_exact(&mut png)?;
    assert_eq!(&png, b"\x89PNG\r\n\x1a\n");
    drop(impatient);
    let mut outcomes: Vec<String> =
        (0..2).map(|_| outcomes.recv_timeout(Duration::from_secs(60))).collect::<Result<_, _>>()?;
    outcomes.sort();
    println!("{outcomes:?}");
    assert_eq!(outcomes, ["12000: canceled", "64: sent"]);
    Ok(())
}
