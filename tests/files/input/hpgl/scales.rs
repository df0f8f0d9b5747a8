//! Scales, turns and windows.

use motion_rtl::input::hpgl::read;

use super::path;
use crate::input::common::{accept, moves};

#[test]
fn scaled_units_land_between_p1_and_p2() {
    // By hand, in plotter units. The default area is 10000 x 7200 from (250, 279).
    let cases: &[(&str, &str)] = &[
        ("SC0,100,0,100;PD50,50", "line to 131.25 96.975 0"),
        ("SC0,100,0,100;PD0,100", "line to 6.25 186.975 0"),
        ("IP0,0,4000,2000;SC-1,1,0,10;PD0,5", "line to 50 25 0"),
        // P2 moves along with P1, to (11000, 7600).
        ("IP1000,400;SC0,10,0,10;PD10,10", "line to 275 190 0"),
        (
            "IP0,0,400,400;IP1000,400;SC0,1,0,1;PD1,1",
            "line to 35 20 0",
        ),
        (
            "IP0,0,40,40;IP;SC0,100,0,100;PD100,100",
            "line to 256.25 186.975 0",
        ),
        // The order of IP and SC does not matter.
        ("SC0,10,0,10;IP0,0,400,800;PD5,5", "line to 5 10 0"),
        ("SC0,10,0,10;SC;PD40,40", "line to 1 1 0"),
        ("SC0,10,0,10;IN;PD40,40", "line to 1 1 0"),
        // 10 plotter units a unit in Y, so too in X; 3000 are left over there.
        (
            "IP0,0,4000,1000;SC0,100,0,100,1;PD100,100",
            "line to 62.5 25 0",
        ),
        (
            "IP0,0,4000,1000;SC0,100,0,100,1,0,50;PD100,100",
            "line to 25 25 0",
        ),
        (
            "IP0,0,4000,1000;SC0,100,0,100,1,100,50;PD100,100",
            "line to 100 25 0",
        ),
        (
            "IP0,0,4000,1000;SC0,100,0,100,0;PD100,100",
            "line to 100 25 0",
        ),
        // Relative moves scale, and the pen stays on the paper when the scale changes.
        ("IP0,0,400,800;SC0,10,0,10;PD;PR5,5", "line to 5 10 0"),
        ("PR40,40;IP0,0,400,800;SC0,10,0,10;PD1,1", "line to 2 3 0"),
    ];
    for (text, expected) in cases {
        let shown = moves(&accept(read, text));
        assert_eq!(
            shown.last().map(String::as_str),
            Some(*expected),
            "{text:?}"
        );
    }
}

#[test]
fn factors_are_plotter_units_a_user_unit() {
    // P1 is (250, 279).
    assert_eq!(path("SC1,10,2,-4,2;PD1,2"), "D250,279");
    assert_eq!(path("SC1,10,2,-4,2;PD3,12"), "D270,239");
    assert_eq!(path("IP0,0,9,9;SC0,2,0,3,2;PD10,10"), "D20,30");
}

#[test]
fn corners_of_the_paper_are_percentages() {
    // The paper is 10365 x 7962.
    assert_eq!(path("IR;SC0,1,0,1;PD1,1"), "D10365,7962");
    assert_eq!(path("IR50,50,100,100;SC0,2,0,2;PD1,1"), "D7773.75,5971.5");
    // P2 moves along, 10000 by 7200 off.
    assert_eq!(path("IR10,20;SC0,1,0,1;PD1,1"), "D11036.5,8792.4");
    assert_eq!(
        path("PS2000,1000;IR25,50,75,100;SC0,1,0,1;PD0,0,1,1"),
        "D500,500 D1500,1000"
    );
    // The turned paper's X is along the other edge.
    // 7962 by 10365 then: (3981, 5182.5) is at (10365 - 5182.5, 3981).
    assert_eq!(path("RO90;IR0,0,50,50;SC0,1,0,1;PD1,1"), "D5182.5,3981");
}

#[test]
fn turns_move_the_origin_to_another_corner() {
    for (turn, drawn) in [
        ("RO0", "D400,0 D400,80"),
        ("RO", "D400,0 D400,80"),
        ("RO90", "U10365,0 D10365,400 D10285,400"),
        ("RO180", "U10365,7962 D9965,7962 D9965,7882"),
        ("RO270", "U0,7962 D0,7562 D80,7562"),
        ("PS1000,500;RO90", "U1000,0 D1000,400 D920,400"),
        ("RO180;RO90", "U10365,0 D10365,400 D10285,400"),
        ("RO90;IN", "D400,0 D400,80"),
        ("RO90;DF", "U10365,0 D10365,400 D10285,400"),
    ] {
        assert_eq!(
            path(&format!("{turn};PU0,0;PD400,0,400,80")),
            drawn,
            "{turn}"
        );
    }
    // The pen stays on the paper, and what follows is relative to there.
    assert_eq!(path("PU1000,500;RO90;PD;PR400,0"), "U1000,500 D1000,900");
    // P1 and P2 keep their coordinates.
    assert_eq!(path("IP100,200,300,400;SC0,1,0,1;RO90;PD0,0"), "D10165,100");
}

#[test]
fn a_window_clips_what_is_drawn_and_not_where_the_pen_is_sent() {
    for (text, drawn) in [
        (
            "IW0,0,400,400;PD200,0,800,0,800,200,200,200",
            "D200,0 D400,0 U400,200 D200,200",
        ),
        // Corners in any order.
        ("IW400,400,0,0;PD200,0,800,0", "D200,0 D400,0"),
        ("IW100,100,200,200;PU0,150;PD300,150", "U100,150 D200,150"),
        (
            "IW100,100,200,200;PU0,0;PD300,0,0,300;PU150,150",
            "U200,100 D100,200 U150,150",
        ),
        // Moves to outside wait for what is drawn next.
        (
            "IW0,0,400,400;PU900,900;PU40,0;PD80,0;PU900,0",
            "U40,0 D80,0",
        ),
        ("IW0,0,400,400;PU900,0;IW;PD900,80", "U900,0 D900,80"),
        ("IW0,0,400,400;PU900,0;DF;PD900,80", "U900,0 D900,80"),
        (
            "IW0,0,400,400;PD800,0;PR-600,0;PR0,40",
            "D400,0 D200,0 D200,40",
        ),
        // In user units, and turned with them.
        ("SC0,10,0,10;IP0,0,100,100;IW0,0,5,5;PD10,0", "D50,0"),
        (
            "PS1000,500;RO90;IW0,0,100,100;PU0,0;PD400,0",
            "U1000,0 D1000,100",
        ),
        // A circle of four chords, half of it outside.
        (
            "IW0,-400,400,400;PU400,0;CI100,90",
            "U400,0 U400,100 D300,0 D400,-100 U400,0",
        ),
    ] {
        assert_eq!(path(text), drawn, "{text:?}");
    }
}
