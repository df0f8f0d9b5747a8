//! Rectangles, wedges and polygons, their edges and fillings.

use motion_rtl::input::hpgl::read;

use super::path;
use crate::input::common::{accept, refuse, warnings};

#[test]
fn edges_of_rectangles_and_wedges_come_back_to_the_pen() {
    for (text, drawn) in [
        (
            "PU80,40;EA400,200;PD0,0",
            "U80,40 D400,40 D400,200 D80,200 D80,40 D0,0",
        ),
        (
            "PD80,40;ER320,160;PR0,-40",
            "D80,40 D400,40 D400,200 D80,200 D80,40 D80,0",
        ),
        (
            "PU100,100;EW100,0,90,45",
            "U100,100 D200,100 D170.71,170.71 D100,200 D100,100",
        ),
        (
            "PU100,100;EW-100,0,-90,90;PD0,0",
            "U100,100 D0,100 D100,200 D100,100 D0,0",
        ),
        // A whole circle has no radii.
        (
            "PU100,100;EW100,0,360,90",
            "U100,100 U200,100 D100,200 D0,100 D100,0 D200,100 U100,100",
        ),
        (
            "IP0,0,100,200;SC0,10,0,10;EA5,5",
            "D50,0 D50,100 D0,100 D0,0",
        ),
    ] {
        assert_eq!(path(text), drawn, "{text}");
    }
}

#[test]
fn fillings_are_lines_and_leave_the_pen_where_it_was() {
    for (text, drawn) in [
        // Lines 0.3 mm apart, in the middle of their strips.
        (
            "PU0,0;RA100,24;PD0,-40",
            "U0,6 D100,6 U100,18 D0,18 U0,0 D0,-40",
        ),
        ("PT0.6;RA100,24", "U0,12 D100,12 U0,0"),
        ("PW0.2;RR100,16", "U0,4 D100,4 U100,12 D0,12 U0,0"),
        ("FT2;RA100,24", "U0,6 D100,6 U0,18 D100,18 U0,0"),
        // The unit is a percentage of the diagonal, 5000.
        (
            "IP0,0,3000,4000;WU1;PW1;RA100,100",
            "U0,25 D100,25 U100,75 D0,75 U0,0",
        ),
        (
            "FT3,40;PU0,10;RA100,90;PD100,10",
            "U0,10 U0,40 D100,40 U100,80 D0,80 U0,10 D100,10",
        ),
        ("FT3,40,90;RA100,90", "U80,0 D80,90 U40,90 D40,0 U0,0"),
        (
            "FT4,80;PU10,10;RA100,100",
            "U10,10 U10,80 D100,80 U80,10 D80,100 U10,10",
        ),
        // Through the anchor.
        ("AC0,30;FT3,80;RA100,100", "U0,30 D100,30 U0,0"),
        // 1 % of the diagonal, in what SC makes of the units else.
        ("IP0,0,3000,4000;FT3;RA90,90", "D90,0 U90,50 D0,50 U0,0"),
        (
            "IP0,0,100,100;SC0,10,0,10;FT3,4;PU0,1;RA10,6",
            "U0,10 U0,40 D100,40 U0,10",
        ),
        (
            "FT3,100;PU0,1;WG200,0,90,90",
            "U0,1 U0,100 D101,100 U1,200 D0,200 U0,1",
        ),
    ] {
        assert_eq!(path(text), drawn, "{text}");
    }
}

#[test]
fn polygons_are_edged_and_filled_as_they_were_recorded() {
    for (text, drawn) in [
        // Nothing moves before EP, and the pen is where it was when polygon mode began.
        (
            "PU40,40;PM;PD80,40,80,80;PM2;PD0,40;PU40,40;EP",
            "U40,40 D0,40 U40,40 D80,40 D80,80 D40,40",
        ),
        // A part drawn with the pen up has no edge.
        (
            "PM0;PD80,0,80,80;PU0,80;PM2;EP;PU0,1",
            "D80,0 D80,80 U0,0 U0,1",
        ),
        // Two parts; the way between is not drawn.
        (
            "PM0;PD90,0,90,90,0,90;PM1;PU30,30;PD60,30,60,60,30,60;PM2;EP",
            "D90,0 D90,90 D0,90 D0,0 U30,30 D60,30 D60,60 D30,60 D30,30 U0,0",
        ),
        // With a hole, by count and by winding.
        (
            "PM0;PD90,0,90,90,0,90;PM1;PU30,30;PD60,30,60,60,30,60;PM2;AC0,45;FT3,900;FP",
            "U0,45 D30,45 U60,45 D90,45 U0,0",
        ),
        (
            "PM0;PD90,0,90,90,0,90;PM1;PU30,30;PD60,30,60,60,30,60;PM2;AC0,45;FT3,900;FP1",
            "U0,45 D30,45 D60,45 D90,45 U0,0",
        ),
        // Circles are parts of their own, arcs parts of parts.
        (
            "PU100,100;PM0;CI50,90;PM2;EP",
            "U100,100 U150,100 D100,150 D50,100 D100,50 D150,100 U100,100",
        ),
        (
            "PU100,0;PM0;PD;AA0,0,90,90;PA0,0;PM2;EP",
            "U100,0 D0,100 D0,0 D100,0",
        ),
        // A rectangle is in the buffer, too.
        ("RA9,9;EP", "U0,4.5 D9,4.5 U0,0 D9,0 D9,9 D0,9 D0,0"),
        ("PM0;PD80,0,80,80;DF;PD0,80;EP", "D0,80"),
        ("PM2;PM1;PD9,9;EP", "D9,9"),
        (
            "PD9,9;PM0;PR9,0,0,9;PM2;PR-9,0;EP",
            "D9,9 D0,9 U9,9 D18,9 D18,18 D9,9 U0,9",
        ),
    ] {
        assert_eq!(path(text), drawn, "{text}");
    }
}

#[test]
fn patterns_stay_empty_and_the_pen_where_it_is() {
    let text = "FT10,50;PU40,40;\nRA400,400;WG9,0,90;FT11,1;FP;PD40,0";
    let drawing = accept(read, text);
    assert_eq!(
        warnings(&drawing),
        [
            "t:2: RA: fillings of type 10 are not drawn, the areas stay empty (2 times)",
            "t:2: FP: fillings of type 11 are not drawn, the areas stay empty",
        ]
    );
    assert_eq!(path(text), "U40,40 D40,0");
}

#[test]
fn what_polygons_cannot_be_is_refused() {
    for (text, problem) in [
        (
            "PM0;\nLBa\x03",
            "t:2: LB: stands in polygon mode; allowed: AA, AR, AT, BR, BZ, CI, PA, PD, PE, PR, PU or RT up to PM2",
        ),
        (
            "PM0;PM0",
            "t:1: PM: polygon mode within polygon mode; allowed: PM1 or PM2 before the next PM0",
        ),
        ("PM3", "t:1: PM: 3 is no polygon mode; allowed: 0, 1 or 2"),
        (
            "FP2",
            "t:1: FP: 2 is no method of filling; allowed: 0 (even and odd) or 1 (winding)",
        ),
        (
            "FT0.5",
            "t:1: FT: 0.5 is no type of filling; allowed: 1 to 4, or the types of patterns",
        ),
        (
            "PT-1",
            "t:1: PT: a pen of negative width; allowed: 0 or more",
        ),
        (
            "CT2",
            "t:1: CT: 2 is no kind of tolerance; allowed: 0 (chord angles) or 1 (deviations)",
        ),
        (
            "SC0,1,0,1;PW0;RA2000,2000;RA2000,2000",
            "t:1: RA: curves, labels and fills make more than 4000000 moves; allowed: larger \
             chord angles, wider fills, or less of them",
        ),
    ] {
        assert_eq!(refuse(read, text), problem, "{text}");
    }
}
