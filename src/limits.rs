//! Every limit on what comes from outside: its value, its reason, and the option that lifts it.
//!
//! A file, a log or a line of a stranger may ask for more memory or time than
//! a machine has. Where such a thing enters, it is measured against a row here
//! before anything is allocated for it. `docs/limits.md` is made from this list.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The most that is taken of something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limit {
    /// What is limited.
    pub name: &'static str,
    /// The most that is taken.
    pub value: u64,
    /// What is counted, in the plural.
    pub unit: &'static str,
    /// Why not more.
    pub reason: &'static str,
    /// The option that lifts it, where one does.
    pub lifted_by: Option<&'static str>,
}

/// Bytes of one line of input.
pub const LINE_BYTES: Limit = Limit {
    name: "a line of input",
    value: 1 << 26,
    unit: "bytes",
    reason: "a line is held whole; a shape of a million corners needs half of it",
    lifted_by: None,
};

/// Bytes of the text of one record.
pub const TEXT_BYTES: Limit = Limit {
    name: "the text of a record",
    value: 1 << 21,
    unit: "bytes",
    reason: "twenty hours of speech; its words and phrases take a hundred times its memory",
    lifted_by: None,
};

/// Bytes of what a conversation remembers.
pub const MEMORY_BYTES: Limit = Limit {
    name: "the memory of a conversation",
    value: 1 << 22,
    unit: "bytes",
    reason: "tens of thousands of pieces of furniture and objects",
    lifted_by: None,
};

/// Bytes of a room map, a scene, or the YAML of a `map_server` pair.
pub const WORLD_FILE_BYTES: Limit = Limit {
    name: "a room map or scene file",
    value: 1 << 25,
    unit: "bytes",
    reason: "the largest home that is taken fills a tenth of it",
    lifted_by: None,
};

/// Bytes of a picture's file, a map's image included.
pub const PICTURE_FILE_BYTES: Limit = Limit {
    name: "a picture file",
    value: 1 << 27,
    unit: "bytes",
    reason: "more than the most pixels fill, uncompressed",
    lifted_by: None,
};

/// Bytes of a mesh file.
pub const MESH_FILE_BYTES: Limit = Limit {
    name: "a mesh file",
    value: 1 << 26,
    unit: "bytes",
    reason: "more than the most triangles fill",
    lifted_by: None,
};

/// Bytes of a treebank or a sheet of groundings.
pub const IMPORT_FILE_BYTES: Limit = Limit {
    name: "a treebank or sheet to import",
    value: 1 << 26,
    unit: "bytes",
    reason: "a hundred times the treebanks that are known",
    lifted_by: None,
};

/// Pixels of a colour, depth or mask picture.
pub const PICTURE_PIXELS: Limit = Limit {
    name: "a picture",
    value: 1 << 24,
    unit: "pixels",
    reason: "4096 × 4096, more than any RGB-D camera gives; a file of 700 bytes can claim 16 times as many",
    lifted_by: None,
};

/// Cells of a raster object.
pub const RASTER_CELLS: Limit = Limit {
    name: "a raster object",
    value: 1 << 24,
    unit: "cells",
    reason: "4096 × 4096; beyond that the correlation would not fit a usual memory",
    lifted_by: None,
};

/// Corners of a shape.
pub const SHAPE_CORNERS: Limit = Limit {
    name: "a shape",
    value: 200_000,
    unit: "corners",
    reason: "a detailed coastline fits; each direction of a histogram sorts all of them",
    lifted_by: None,
};

/// Cells of a `map_server` image.
pub const MAP_CELLS: Limit = Limit {
    name: "the image of a map",
    value: 1 << 24,
    unit: "cells",
    reason: "4096 × 4096, which at 0.05 m a cell is the largest home",
    lifted_by: None,
};

/// How far apart two points of a home may lie along one axis.
pub const HOME_EXTENT_M: Limit = Limit {
    name: "a home from end to end",
    value: 200,
    unit: "metres",
    reason: "a hospital ward fits; a home drawn in millimetres or centimetres does not",
    lifted_by: None,
};

/// How far from the world's origin a home may lie.
pub const HOME_COORDINATE_M: Limit = Limit {
    name: "a coordinate of a home, from the world's origin",
    value: 100_000,
    unit: "metres",
    reason: "farther off, what is computed from the origin loses its millimetres",
    lifted_by: None,
};

/// Height of a home's walls.
pub const WALL_HEIGHT_M: Limit = Limit {
    name: "the height of walls",
    value: 50,
    unit: "metres",
    reason: "a hall fits; a height in millimetres does not",
    lifted_by: None,
};

/// Length, width and height of a piece of furniture.
pub const ITEM_SIZE_M: Limit = Limit {
    name: "the length, width or height of a piece of furniture",
    value: 20,
    unit: "metres",
    reason: "a long counter fits; a size in millimetres does not",
    lifted_by: None,
};

/// Rooms of a home.
pub const HOME_ROOMS: Limit =
    Limit { name: "a home", value: 200, unit: "rooms", reason: "each is compared with each", lifted_by: None };

/// Doors of a home.
pub const HOME_DOORS: Limit =
    Limit { name: "a home", value: 400, unit: "doors", reason: "each is looked for in each wall", lifted_by: None };

/// Corners of all outlines of a home.
pub const HOME_CORNERS: Limit = Limit {
    name: "a home",
    value: 4_000,
    unit: "corners of outlines",
    reason: "each edge is compared with each",
    lifted_by: None,
};

/// Walls inside the rooms of a home.
pub const HOME_INNER_WALLS: Limit = Limit {
    name: "a home",
    value: 20_000,
    unit: "inner walls",
    reason: "each is drawn into every grid; a map's image makes one of each row of occupied cells",
    lifted_by: None,
};

/// Pieces of furniture in a scene.
pub const SCENE_ITEMS: Limit = Limit {
    name: "a scene",
    value: 400,
    unit: "pieces of furniture",
    reason: "each is compared with each, and every picture looks at all",
    lifted_by: None,
};

/// Portable objects in a scene.
pub const SCENE_OBJECTS: Limit =
    Limit { name: "a scene", value: 1_000, unit: "objects", reason: "every picture looks at all", lifted_by: None };

/// Triangles of a mesh.
pub const MESH_TRIANGLES: Limit = Limit {
    name: "a mesh",
    value: 1_000_000,
    unit: "triangles",
    reason: "more no piece of furniture needs, and a camera would be slow",
    lifted_by: None,
};

/// Area of a mesh's triangles together against that of its box.
pub const MESH_LAYERS: Limit = Limit {
    name: "a mesh, for each surface of its box",
    value: 50,
    unit: "times the area of the box in triangles",
    reason: "each layer is drawn in every picture; a shelf with all its boards has 10",
    lifted_by: None,
};

/// Cells of a sheet.
pub const SHEET_CELLS: Limit = Limit {
    name: "a sheet to import",
    value: 1 << 20,
    unit: "cells",
    reason: "a file of a few bytes can claim 4 thousand million",
    lifted_by: None,
};

/// Bytes of all parts of a spreadsheet file, unpacked.
pub const SHEET_PART_BYTES: Limit = Limit {
    name: "a spreadsheet, unpacked",
    value: 1 << 26,
    unit: "bytes",
    reason: "a small file can unpack to any size",
    lifted_by: None,
};

/// Elements within elements of a treebank, or brackets within brackets.
pub const TREE_DEPTH: Limit = Limit {
    name: "a tree to import",
    value: 1_000,
    unit: "levels",
    reason: "no sentence nests deeper",
    lifted_by: None,
};

/// Bytes of one record of an MCAP log.
pub const MCAP_RECORD_BYTES: Limit = Limit {
    name: "a record of an MCAP log",
    value: 1 << 30,
    unit: "bytes",
    reason: "a longer one is left out and said: it would have to stand in memory whole",
    lifted_by: None,
};

/// Bytes of a chunk of an MCAP log, unpacked.
pub const MCAP_CHUNK_BYTES: Limit = Limit {
    name: "a chunk of an MCAP log, unpacked",
    value: 384 << 20,
    unit: "bytes",
    reason: "a chunk is held whole until its checksum is known, and its messages beside it",
    lifted_by: None,
};

/// Unpacked bytes of a chunk for each packed one.
pub const MCAP_CHUNK_RATIO: Limit = Limit {
    name: "a chunk of an MCAP log",
    value: 200,
    unit: "unpacked bytes for each packed one",
    reason: "pictures pack by 2 to 50; 22 kB that unpack to gigabytes are no recording",
    lifted_by: None,
};

/// Bytes to which the chunks of a log unpack that are beyond the ratio.
pub const MCAP_PACKED_WELL_BYTES: Limit = Limit {
    name: "the chunks of an MCAP log beyond that ratio, together",
    value: 512 << 20,
    unit: "unpacked bytes",
    reason: "a few that hold zeros are sound, thousands are a trap",
    lifted_by: None,
};

/// Messages in them.
pub const MCAP_PACKED_WELL_MESSAGES: Limit = Limit {
    name: "the chunks of an MCAP log beyond that ratio, together, in messages",
    value: 100_000,
    unit: "messages",
    reason: "each takes time, however little it was packed to: 8 kB held three million",
    lifted_by: None,
};

/// Frames that wait for their other half or for a transform.
pub const MCAP_WAITING: Limit = Limit {
    name: "a log's pictures that wait for their camera or for each other",
    value: 64,
    unit: "pictures",
    reason: "they are held in memory; what waits longer has no partner",
    lifted_by: None,
};

/// Links of a chain of frames in a log.
pub const TRANSFORM_CHAIN: Limit = Limit {
    name: "a chain of transforms",
    value: 64,
    unit: "links",
    reason: "a robot has fewer; a circle has no end",
    lifted_by: None,
};

/// Seconds that a detector of one's own may take for one frame.
pub const DETECTOR_SECONDS: Limit = Limit {
    name: "the answer of a --detector to one frame",
    value: 120,
    unit: "seconds",
    reason: "the first frame may have to wait for a model to be loaded; a command that hangs would hold up everything",
    lifted_by: Some("--detector-patience"),
};

/// Bytes of a detector's answer to one frame.
pub const DETECTOR_ANSWER_BYTES: Limit = Limit {
    name: "the answer of a --detector to one frame",
    value: 1 << 22,
    unit: "bytes",
    reason: "thousands of detections fit; a flood without line ends has no end",
    lifted_by: None,
};

/// All limits.
pub const ALL: &[Limit] = &[
    LINE_BYTES,
    TEXT_BYTES,
    MEMORY_BYTES,
    WORLD_FILE_BYTES,
    PICTURE_FILE_BYTES,
    MESH_FILE_BYTES,
    IMPORT_FILE_BYTES,
    PICTURE_PIXELS,
    RASTER_CELLS,
    SHAPE_CORNERS,
    MAP_CELLS,
    HOME_EXTENT_M,
    HOME_COORDINATE_M,
    WALL_HEIGHT_M,
    ITEM_SIZE_M,
    HOME_ROOMS,
    HOME_DOORS,
    HOME_CORNERS,
    HOME_INNER_WALLS,
    SCENE_ITEMS,
    SCENE_OBJECTS,
    MESH_TRIANGLES,
    MESH_LAYERS,
    SHEET_CELLS,
    SHEET_PART_BYTES,
    TREE_DEPTH,
    MCAP_RECORD_BYTES,
    MCAP_CHUNK_BYTES,
    MCAP_CHUNK_RATIO,
    MCAP_PACKED_WELL_BYTES,
    MCAP_PACKED_WELL_MESSAGES,
    MCAP_WAITING,
    TRANSFORM_CHAIN,
    DETECTOR_SECONDS,
    DETECTOR_ANSWER_BYTES,
];

impl Limit {
    /// The most, as a count of things in memory.
    pub const fn count(self) -> usize {
        self.value as usize
    }

    /// Says that `found` is too much; says nothing where it is not.
    ///
    /// # Errors
    /// When more are found than the limit: how many, how many are taken, and what lifts it.
    pub fn check(self, found: usize) -> Result<(), String> {
        if found as u64 <= self.value {
            return Ok(());
        }
        Err(self.exceeded(&found.to_string()))
    }

    /// What is said of something that is beyond the limit; `found` is how much there is, in words.
    pub fn exceeded(self, found: &str) -> String {
        let lift = self.lifted_by.map_or(String::new(), |option| format!("; {option} takes more"));
        format!("{found} {} are more than the {} that are taken of {}{lift}", self.unit, self.value, self.name)
    }

    /// Reads a file that may have at most this many bytes; one without an end, `/dev/zero`, is refused like a long one.
    ///
    /// # Errors
    /// What the system says, or that the file is too long.
    pub fn read(self, path: &Path) -> io::Result<Vec<u8>> {
        self.read_from(File::open(path)?)
    }

    /// [`Limit::read`] for a text.
    ///
    /// # Errors
    /// What the system says, that the file is too long, or that it is no UTF-8.
    pub fn read_text(self, path: &Path) -> io::Result<String> {
        let bytes = self.read(path)?;
        String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            io::Error::new(io::ErrorKind::InvalidData, format!("is no UTF-8 text (byte {})", at + 1))
        })
    }

    /// Reads all of a source that may have at most this many bytes.
    ///
    /// # Errors
    /// What the system says, or that there are too many.
    pub fn read_from(self, source: impl Read) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        source.take(self.value + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > self.value {
            let what = format!("more than the {} bytes that are taken of {}", self.value, self.name);
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, what));
        }
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_without_an_end_is_refused_at_the_limit() {
        let few = Limit { value: 10, ..LINE_BYTES };
        assert_eq!(few.read_from([7; 10].as_slice()).expect("just as many").len(), 10);
        let error = few.read_from(io::repeat(0)).expect_err("endless").to_string();
        assert_eq!(error, "more than the 10 bytes that are taken of a line of input");
    }

    #[test]
    fn what_is_too_much_is_said_with_what_lifts_it() {
        let limit = Limit { value: 3, unit: "rooms", name: "a home", lifted_by: Some("--large"), ..HOME_ROOMS };
        assert_eq!(limit.check(3), Ok(()));
        let said = limit.check(4).expect_err("too many");
        assert_eq!(said, "4 rooms are more than the 3 that are taken of a home; --large takes more");
    }

    #[test]
    fn every_limit_of_this_file_is_in_the_list() {
        let source = include_str!("limits.rs").split("\n#[cfg(test)]").next().unwrap_or_default();
        let constants = source.lines().filter(|line| line.starts_with("pub const") && line.contains(": Limit ="));
        assert_eq!(constants.count(), ALL.len());
    }
}
