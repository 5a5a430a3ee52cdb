//! What was learned from rendered rooms: four forests, and the sizes of furniture.

use std::sync::{Arc, LazyLock};

use super::forest::{Forest, take};
use crate::catalogue::{FAMILIES, Size};

/// The first bytes of a model file.
const MAGIC: &[u8; 8] = b"SFPERC02";
/// The categories a piece may be of, those it is trained on; after them comes "none of these". Their order is that of a
/// model file.
pub const CATEGORIES: [&str; FAMILIES.len()] = FAMILIES;
/// The class of what is no furniture.
pub const NOTHING: usize = CATEGORIES.len();

/// All that the detector has learned.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Whether two patches are one piece.
    pub joining: Forest,
    /// Which category a piece is of.
    pub category: Forest,
    /// Whether a side of a piece is its front.
    pub front: Forest,
    /// Which of the portable objects a thing on a table is; the last class is none of them.
    pub object: Forest,
    /// Sizes of pieces of each category.
    pub sizes: Vec<Vec<Size>>,
}

impl Model {
    /// The model that is shipped; `evaluate train` makes it anew.
    pub fn shipped() -> Arc<Self> {
        static SHIPPED: LazyLock<Arc<Model>> =
            LazyLock::new(|| {
                // An empty model would see nothing, and say nothing of it.
                let model = Model::read(include_bytes!("furniture.model"));
                Arc::new(model.unwrap_or_else(|| {
                    panic!("the embedded furniture.model is of another version; run `evaluate train`")
                }))
            });
        SHIPPED.clone()
    }

    /// The model as a file.
    pub fn write(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        for forest in [&self.joining, &self.category, &self.front, &self.object] {
            forest.write(&mut bytes);
        }
        for sizes in &self.sizes {
            bytes.extend((sizes.len() as u16).to_le_bytes());
            let millimetres =
                sizes.iter().flat_map(|s| [s.length, s.width, s.height]).map(|v| (v * 1000.0).round() as u16);
            bytes.extend(millimetres.flat_map(u16::to_le_bytes));
        }
        bytes
    }

    /// Reads a model file; nothing when it is none, or of another version.
    pub fn read(mut bytes: &[u8]) -> Option<Self> {
        let bytes = &mut bytes;
        if &take::<8>(bytes)? != MAGIC {
            return None;
        }
        let mut forest = || Forest::read(bytes);
        let [joining, category, front, object] = [forest()?, forest()?, forest()?, forest()?];
        let mut sizes = Vec::new();
        for _ in CATEGORIES {
            let count = u16::from_le_bytes(take(bytes)?);
            let mut number = || take(bytes).map(|raw| f64::from(u16::from_le_bytes(raw)) / 1000.0);
            let some: Option<Vec<Size>> =
                (0..count).map(|_| Some(Size { length: number()?, width: number()?, height: number()? })).collect();
            sizes.push(some?);
        }
        Some(Self { joining, category, front, object, sizes })
    }
}
