//! The declarations at the head of a dump.

use super::text::{Id, Signal};
use crate::kernel::Role;
use crate::trace::Clock;
use crate::trace::layout::{CLK, Layout, Scope, companion};
use std::io;
use vcd::{ReferenceIndex, VarType};

pub fn header(
    out: &mut Vec<u8>,
    layout: &Layout,
    signals: &[Signal],
    clock: Clock,
    clk: Id,
) -> io::Result<()> {
    let mut out = vcd::Writer::new(out);
    out.version(concat!("motion-rtl ", env!("CARGO_PKG_VERSION")))?;
    out.comment(&clock.to_string())?;
    let (factor, unit) = clock.timescale();
    out.timescale(factor, unit)?;
    out.add_module(&layout.top.name)?;
    out.var_def(VarType::Wire, 1, clk.code(), CLK, None)?;
    variables(&mut out, &layout.top, layout, signals)?;
    out.upscope()?;
    out.enddefinitions()
}

fn variables(
    out: &mut vcd::Writer<&mut Vec<u8>>,
    scope: &Scope,
    layout: &Layout,
    signals: &[Signal],
) -> io::Result<()> {
    for &index in &scope.leaves {
        let (leaf, signal) = (&layout.leaves[index], &signals[index]);
        let kind = match leaf.role {
            Role::Register => VarType::Reg,
            Role::Input | Role::Net => VarType::Wire,
        };
        let width = leaf.shape.width;
        let range = (width > 1).then(|| ReferenceIndex::Range(width as i32 - 1, 0));
        out.var_def(kind, width as u32, signal.id.code(), &leaf.name, range)?;
        if let (Some((id, _)), Some(name)) = (signal.states, companion(leaf)) {
            out.var_def(VarType::String, 1, id.code(), &name, None)?;
        }
    }
    for inner in &scope.scopes {
        out.add_module(&inner.name)?;
        variables(out, inner, layout, signals)?;
        out.upscope()?;
    }
    Ok(())
}
