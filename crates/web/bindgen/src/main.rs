//! `web-bindgen MODULE.wasm FOLDER` writes the module and its JavaScript bindings, `web_bg.wasm`
//! and `web.js`, to a folder.

use std::error::Error;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [module, folder] = arguments.as_slice() else {
        return Err("usage: web-bindgen MODULE.wasm FOLDER".into());
    };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).typescript(false).remove_producers_section(true);
    // Function names take up a quarter of the module, and only debuggers read them.
    bindgen.remove_name_section(true).web(true)?.generate(folder)?;
    Ok(())
}
