//! Wavefront OBJ files.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use crate::limits::MESH_TRIANGLES;

/// The triangles of a file, in its own axes and unit.
pub(super) fn read(path: &Path) -> Result<Vec<[[f64; 3]; 3]>, String> {
    let file = File::open(path).map_err(|error| error.to_string())?;
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    // Colours come from the scene, so that no material library is needed.
    let no_material = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut BufReader::new(file), &options, no_material)
        .map_err(|error| format!("not a Wavefront OBJ that can be read: {error}"))?;
    let mut triangles = Vec::new();
    for model in &models {
        let corner = |&index: &u32| {
            let at = 3 * index as usize;
            let xyz = model.mesh.positions.get(at..at + 3)?;
            Some([xyz[0], xyz[1], xyz[2]])
        };
        for face in model.mesh.indices.chunks_exact(3) {
            let corners = (corner(&face[0]), corner(&face[1]), corner(&face[2]));
            let (Some(a), Some(b), Some(c)) = corners else {
                return Err("a face names a vertex that is not there".into());
            };
            triangles.push([a, b, c]);
        }
    }
    match triangles.len() {
        0 => Err("has no triangles; export it with faces".to_string()),
        count => MESH_TRIANGLES.check(count).map(|()| triangles),
    }
}
