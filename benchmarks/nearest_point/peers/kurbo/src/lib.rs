//! kurbo's nearest points for the benchmark: the parameter, point and squared distance of each.

use kurbo::{CubicBez, Line, ParamCurve, ParamCurveNearest, Point};

fn write(curve: impl ParamCurveNearest + ParamCurve, x: f64, y: f64, accuracy: f64, answer: *mut f64) {
    let nearest = curve.nearest(Point::new(x, y), accuracy);
    let point = curve.eval(nearest.t);
    let values = [nearest.t, point.x, point.y, nearest.distance_sq];
    unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), answer, values.len()) }
}

/// # Safety
/// `control_points` holds 4 numbers, `answer` has space for 4.
#[no_mangle]
pub unsafe extern "C" fn calligraphy_kurbo_line(
    control_points: *const f64,
    x: f64,
    y: f64,
    accuracy: f64,
    answer: *mut f64,
) {
    let p = std::slice::from_raw_parts(control_points, 4);
    write(Line::new((p[0], p[1]), (p[2], p[3])), x, y, accuracy, answer)
}

/// # Safety
/// `control_points` holds 8 numbers, `answer` has space for 4.
#[no_mangle]
pub unsafe extern "C" fn calligraphy_kurbo_cubic(
    control_points: *const f64,
    x: f64,
    y: f64,
    accuracy: f64,
    answer: *mut f64,
) {
    let p = std::slice::from_raw_parts(control_points, 8);
    let curve = CubicBez::new((p[0], p[1]), (p[2], p[3]), (p[4], p[5]), (p[6], p[7]));
    write(curve, x, y, accuracy, answer)
}
