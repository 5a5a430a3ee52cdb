//! The intrinsics of a picture by the description of its camera: binned, cut out or scaled as the picture was.

use super::sensed::Info;
use crate::frame::Intrinsics;

/// Pixels by which a size may be off from rounding.
const ROUNDING: u32 = 1;

/// The intrinsics of a picture of `width` × `height` pixels.
///
/// # Errors
/// When the camera's description is that of a picture of another size, and nothing says how one comes of the other.
pub(super) fn intrinsics_for(info: &Info, width: usize, height: usize) -> Result<Option<Intrinsics>, String> {
    let Some(whole) = info.intrinsics else { return Ok(None) };
    let picture = [width as u32, height as u32];
    let (read, size) = as_read(info, whole);
    if info.width == 0 || near(size, picture) {
        return Ok(Some(read));
    }
    if [info.width, info.height] == picture {
        return Ok(Some(whole));
    }
    let scale = f64::from(picture[0]) / f64::from(size[0].max(1));
    let same_shape = (f64::from(size[1]) * scale - f64::from(picture[1])).abs() < 1.5;
    if same_shape && size[0] > 0 {
        return Ok(Some(scaled(read, scale)));
    }
    let [w, h] = size;
    Err(format!("it has {width} × {height} pixels, but its camera info describes {w} × {h} of another shape"))
}

/// The intrinsics and size of what the sensor gives, cut out and binned.
fn as_read(info: &Info, k: Intrinsics) -> (Intrinsics, [u32; 2]) {
    let [column, row, width, height] = info.window;
    let size = if width == 0 || height == 0 { [info.width, info.height] } else { [width, height] };
    let [x, y] = info.binning.map(|binning| binning.max(1));
    let (across, down) = (f64::from(x), f64::from(y));
    let cut = Intrinsics { cx: k.cx - f64::from(column), cy: k.cy - f64::from(row), ..k };
    let binned = Intrinsics { fx: cut.fx / across, fy: cut.fy / down, cx: cut.cx / across, cy: cut.cy / down };
    (binned, [size[0] / x, size[1] / y])
}

fn near(a: [u32; 2], b: [u32; 2]) -> bool {
    a[0].abs_diff(b[0]) <= ROUNDING && a[1].abs_diff(b[1]) <= ROUNDING
}

fn scaled(k: Intrinsics, scale: f64) -> Intrinsics {
    Intrinsics { fx: k.fx * scale, fy: k.fy * scale, cx: k.cx * scale, cy: k.cy * scale }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::sensed::Header;

    fn info(binning: [u32; 2], window: [u32; 4]) -> Info {
        let header = Header { stamp_ns: 0, frame: String::new() };
        let intrinsics = Some(Intrinsics { fx: 500.0, fy: 510.0, cx: 320.0, cy: 240.0 });
        Info { header, width: 640, height: 480, intrinsics, binning, window }
    }

    fn told(info: &Info, width: usize, height: usize) -> [f64; 4] {
        let k = intrinsics_for(info, width, height).expect("fits").expect("known");
        [k.fx, k.fy, k.cx, k.cy]
    }

    #[test]
    fn binned_scaled_and_cut_pictures_have_their_own_intrinsics() {
        let plain = info([0; 2], [0; 4]);
        assert_eq!(told(&plain, 640, 480), [500.0, 510.0, 320.0, 240.0]);
        assert_eq!(told(&plain, 320, 240), [250.0, 255.0, 160.0, 120.0], "scaled");
        assert_eq!(told(&info([2, 2], [0; 4]), 320, 240), [250.0, 255.0, 160.0, 120.0], "binned");
        assert_eq!(told(&info([0; 2], [100, 50, 400, 300]), 400, 300), [500.0, 510.0, 220.0, 190.0], "cut out");
        assert_eq!(told(&info([2, 2], [100, 50, 400, 300]), 200, 150), [250.0, 255.0, 110.0, 95.0], "both");
    }

    #[test]
    fn a_picture_of_another_shape_is_refused_with_both_sizes() {
        let error = intrinsics_for(&info([0; 2], [0; 4]), 512, 424).expect_err("another shape");
        assert!(error.contains("512 × 424") && error.contains("640 × 480"), "{error}");
    }
}
