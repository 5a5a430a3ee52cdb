//! Wavefront OBJ files.

use std::path::Path;

use crate::limits::{MESH_FILE_BYTES, MESH_TRIANGLES};

/// The triangles of a file, in its own axes and unit.
pub(super) fn read(path: &Path) -> Result<Vec<[[f64; 3]; 3]>, String> {
    let bytes = MESH_FILE_BYTES.read(path).map_err(|error| error.to_string())?;
    MESH_TRIANGLES.check(triangles_in(&bytes))?;
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    // Colours come from the scene, so that no material library is needed.
    let no_material = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut bytes.as_slice(), &options, no_material)
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
        _ => Ok(triangles),
    }
}

/// How many triangles the faces of a file make, before memory is taken for them: a face of n corners makes n − 2.
fn triangles_in(bytes: &[u8]) -> usize {
    let faces = bytes.split(|byte| *byte == b'\n').filter_map(|line| line.trim_ascii_start().strip_prefix(b"f"));
    let corners = |face: &[u8]| face.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).count();
    faces.map(|face| corners(face).saturating_sub(2)).sum()
}
