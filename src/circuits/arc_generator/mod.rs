//! The arc generator of JPH0743606B2.
//!
//! ```text
//!  path ──▶ prepare ──▶ record ──▶ segments      A ┄┄ blend ┄┄▶ A⁺ ── rotation ──▶ C⁻ ┄┄ blend ┄┄▶ C
//!                                  in memory        quartic         Δθ a sample        quartic
//! ```
//!
//! A path of lines and arcs in space becomes *segments*, each of a whole number of sampling periods
//! Ts. At ends and corners there are *blends*: quartics of the duration 2ta, which continue
//! position and velocity of their neighbours. Between the blends there are lines and *rotations*;
//! in a rotation, one constant matrix multiplies the vector from the centre in every sample. All
//! constants are computed once, in `f64` and exact integers. Per sample the circuit only adds; on
//! an arc it also multiplies by constants.
//!
//! Its program on the control computer is in [`jobs`](crate::jobs::arc_generator).
//! `rtl_notes/arc_generator/README.md` is the note of this circuit.

pub mod angle_step;
pub mod axis_terms;
pub mod blend_point;
pub mod blend_row;
pub mod blend_weight;
pub mod conventional;
pub mod generator;
pub mod matrix_element;
pub mod position_command;
pub mod rotation;
pub mod rotation_row;
pub mod sine_words;
pub mod vector_row;
pub mod widths;

pub use angle_step::AngleStep;
pub use axis_terms::AxisTerms;
pub use blend_point::BlendPoint;
pub use blend_row::BlendRow;
pub use blend_weight::BlendWeight;
pub use conventional::Conventional;
pub use generator::ArcGenerator;
pub use matrix_element::MatrixElement;
pub use position_command::PositionCommand;
pub use rotation::Rotation;
pub use rotation_row::RotationRow;
pub use sine_words::SineWords;
pub use vector_row::VectorRow;
pub use widths::Widths;

/// Rounding of the points of a rotation to guard units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rounding {
    /// To the nearest, a half upwards.
    #[default]
    Nearest,
    /// Down.
    Floor,
}

impl Rounding {
    /// The name it has in scenarios.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Rounding::Nearest => "nearest",
            Rounding::Floor => "floor",
        }
    }
}

/// Method for the points of blends and lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Blend {
    /// By additions, from the differences of the quartic.
    #[default]
    Differences,
    /// By products, from \[5\] and \[10\] as they are written.
    Products,
}

impl Blend {
    /// The name it has in scenarios.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Blend::Differences => "differences",
            Blend::Products => "products",
        }
    }

    /// Widths of a generator with this method: with products, a modulus is M itself.
    #[must_use]
    pub const fn widths(self, widths: Widths) -> Widths {
        match self {
            Blend::Differences => widths,
            Blend::Products => Widths {
                fraction: widths.samples + 1,
                ..widths
            },
        }
    }

    /// Largest number of samples of a blend: even, and its modulus fits.
    #[must_use]
    pub fn most_samples(self, widths: &Widths) -> u64 {
        match self {
            Blend::Differences => widths.most_blend_samples(),
            Blend::Products => widths.most_samples() - 1,
        }
    }
}
