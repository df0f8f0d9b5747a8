//! Declarations at the head of a dump.

use super::file::CLK_CODE;
use crate::netlist::Role;
use crate::trace::Clock;
use crate::trace::PORTS_OUT;
use crate::trace::layout::{CLK, Layout, Scope, companion};
use std::io;
use vcd::{IdCode, ReferenceIndex, VarType};

/// Writes the declarations; `variables` gives the variable of each leaf. The names of its states
/// are the variable after it.
pub fn header(
    out: &mut Vec<u8>,
    layout: &Layout,
    variables: &[u32],
    clock: Clock,
) -> io::Result<()> {
    let mut out = vcd::Writer::new(out);
    out.version(concat!("motion-rtl ", env!("CARGO_PKG_VERSION")))?;
    out.comment(&clock.to_string())?;
    if let Some(comment) = &layout.comment {
        out.comment(comment)?;
    }
    if !layout.ports_out.is_empty() {
        let paths = layout
            .ports_out
            .iter()
            .map(|&leaf| layout.leaves[leaf].path());
        let paths: Vec<String> = paths.collect();
        out.comment(&format!("{PORTS_OUT} {}", paths.join(" ")))?;
    }
    let (factor, unit) = clock.timescale();
    out.timescale(factor, unit.parse().map_err(io::Error::other)?)?;
    out.add_module(&layout.top.name)?;
    out.var_def(VarType::Wire, 1, CLK_CODE, CLK, None)?;
    scope(&mut out, &layout.top, layout, variables)?;
    out.upscope()?;
    out.enddefinitions()
}

fn scope(
    out: &mut vcd::Writer<&mut Vec<u8>>,
    this: &Scope,
    layout: &Layout,
    variables: &[u32],
) -> io::Result<()> {
    for &index in &this.leaves {
        let (leaf, variable) = (&layout.leaves[index], variables[index]);
        let kind = match leaf.role {
            Role::Register => VarType::Reg,
            Role::Input | Role::Net => VarType::Wire,
        };
        let width = leaf.shape.width;
        let range = (width > 1).then(|| ReferenceIndex::Range(width as i32 - 1, 0));
        out.var_def(
            kind,
            width as u32,
            IdCode::from(variable),
            &leaf.name,
            range,
        )?;
        if let Some(name) = companion(leaf) {
            out.var_def(VarType::String, 1, IdCode::from(variable + 1), &name, None)?;
        }
    }
    for inner in &this.scopes {
        out.add_module(&inner.name)?;
        scope(out, inner, layout, variables)?;
        out.upscope()?;
    }
    Ok(())
}
