//! Colours and patterns as furniture has them.

use crate::catalogue::Color;
use crate::simulation::Dice;
use crate::simulation::camera::{Finish, Texture};

const WOODS: [Color; 8] = [
    [186, 148, 98],
    [150, 105, 65],
    [95, 62, 40],
    [214, 188, 150],
    [120, 72, 45],
    [70, 50, 40],
    [168, 124, 84],
    [200, 160, 110],
];
const PAINTS: [Color; 6] =
    [[232, 232, 228], [245, 243, 236], [58, 58, 62], [120, 124, 126], [176, 190, 186], [40, 40, 44]];
const CLOTHS: [Color; 12] = [
    [92, 110, 138],
    [120, 120, 118],
    [70, 72, 78],
    [172, 158, 136],
    [214, 208, 196],
    [124, 48, 44],
    [70, 96, 72],
    [52, 62, 96],
    [150, 92, 56],
    [190, 160, 60],
    [98, 64, 44],
    [40, 40, 42],
];
const LINENS: [Color; 8] = [
    [226, 222, 212],
    [240, 240, 238],
    [150, 170, 196],
    [196, 150, 150],
    [120, 130, 110],
    [90, 96, 120],
    [200, 190, 150],
    [120, 60, 66],
];
const METALS: [Color; 4] = [[60, 60, 64], [150, 152, 156], [196, 198, 200], [36, 36, 38]];

fn varied(dice: &mut Dice, color: Color, by: f64) -> Color {
    let light = dice.normal(1.0, by);
    color.map(|c| (f64::from(c) * light + dice.normal(0.0, 60.0 * by)).clamp(8.0, 250.0) as u8)
}

/// Wood, or painted wood.
pub fn wooden(dice: &mut Dice) -> Finish {
    if dice.chance(0.3) {
        let color = dice.pick(&PAINTS);
        return Finish::new(varied(dice, color, 0.06), Texture::Plain);
    }
    let color = dice.pick(&WOODS);
    Finish::new(varied(dice, color, 0.1), Texture::Wood)
}

/// Upholstery.
pub fn upholstered(dice: &mut Dice) -> Finish {
    let color = dice.pick(&CLOTHS);
    Finish::new(varied(dice, color, 0.1), Texture::Cloth)
}

/// Bed linen.
pub fn linen(dice: &mut Dice) -> Finish {
    let color = dice.pick(&LINENS);
    Finish::new(varied(dice, color, 0.08), Texture::Cloth)
}

/// Steel, black or bright.
pub fn metal(dice: &mut Dice) -> Finish {
    let color = dice.pick(&METALS);
    Finish::new(varied(dice, color, 0.06), Texture::Plain)
}

/// Any colour at all: spines of books, ornaments.
pub fn gaudy(dice: &mut Dice) -> Finish {
    let color = [0; 3].map(|_: u8| dice.between(20.0, 235.0) as u8);
    Finish::new(color, Texture::Plain)
}

/// The same, darker or lighter.
pub fn shade(finish: Finish, factor: f64) -> Finish {
    Finish { color: finish.color.map(|c| (f64::from(c) * factor).clamp(0.0, 255.0) as u8), ..finish }
}
