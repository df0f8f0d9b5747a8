//! Joints of an arm along commands, against all of its angles at once.

use super::*;
use motion_rtl::jobs::arc_generator::joints::Following;
use motion_rtl::path::arm::{Arm, Elbow};

const ARM: Arm = Arm {
    shoulder_mm: [0.0, 0.0, 350.0],
    upper_mm: 300.0,
    fore_mm: 350.0,
    elbow: Elbow::Up,
    singular_deg: 1.0,
    counts_per_rev: 4096,
};

#[test]
fn figures_are_those_of_all_angles() {
    // To and fro, faster back than forth in every joint.
    let along = |k: i32| f64::from(if k < 60 { k } else { 60 - 3 * (k - 60) });
    let point = |k: i32| [400.0 + along(k), -200.0 + 2.0 * along(k), 300.0 - along(k)];
    let (points, sample_s): (Vec<Point>, _) = ((0..80).map(point).collect(), 1e-3);
    let mut following = Following::new(&ARM, sample_s);
    points
        .iter()
        .for_each(|point| following.take(*point).unwrap());
    let followed = following.finish();

    let angles: Vec<_> = points
        .iter()
        .map(|point| ARM.joints(*point).unwrap())
        .collect();
    let turn = f64::from(ARM.counts_per_rev) / std::f64::consts::TAU;
    let counts = |all: &[f64; 3]| all.map(|angle| (angle * turn).round());
    assert_eq!(followed.start.map(|count| count as f64), counts(&angles[0]));
    let off = angles.iter().zip(&points).map(|(all, point)| {
        length(minus(
            ARM.hand(counts(all).map(|count| count / turn)),
            *point,
        ))
    });
    assert!((followed.rounding_mm - off.fold(0.0, f64::max)).abs() < 1e-12);
    for (joint, report) in followed.joints.iter().enumerate() {
        let own: Vec<f64> = angles.iter().map(|all| all[joint].to_degrees()).collect();
        let slopes = |all: &[f64]| -> Vec<f64> {
            all.windows(2)
                .map(|pair| (pair[1] - pair[0]) / sample_s)
                .collect()
        };
        let largest = |all: &[f64]| all.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let speeds = slopes(&own);
        let range = own.iter().fold(
            [f64::INFINITY, f64::NEG_INFINITY],
            |[least, most], angle| [least.min(*angle), most.max(*angle)],
        );
        let found = [
            report.range_deg[0],
            report.range_deg[1],
            report.speed_deg_per_s,
            report.acceleration_deg_per_s2,
        ];
        let wanted = [
            range[0],
            range[1],
            largest(&speeds),
            largest(&slopes(&speeds)),
        ];
        for (found, wanted) in found.into_iter().zip(wanted) {
            // The base is counted on from the angle before.
            assert!(
                (found / wanted - 1.0).abs() < 1e-9,
                "{joint}: {found}, not {wanted}"
            );
        }
    }
}

#[test]
fn a_command_out_of_reach_is_named() {
    let mut following = Following::new(&ARM, 1e-3);
    following.take([400.0, 0.0, 300.0]).unwrap();
    let (number, _) = following.take([900.0, 0.0, 300.0]).unwrap_err();
    assert_eq!(number, 1);
}
