//! Report of all faults of a file, with their lines.

use super::voice;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use motion_rtl::input::{Fault, MOST_FAULTS};

/// The widest excerpt with its number, in columns.
const WIDTH: usize = 200;

/// A fault and those after it, each with its line and a caret under what is at fault.
pub fn report(fault: &Fault) -> String {
    let renderer = match voice::colors_errors() {
        true => Renderer::styled(),
        false => Renderer::plain(),
    };
    let renderer = renderer.term_width(WIDTH);
    let mut told: Vec<String> = fault.all().map(|fault| one(fault, &renderer)).collect();
    if told.len() == MOST_FAULTS {
        told.push(format!(
            "only the first {MOST_FAULTS} errors are shown; there may be more"
        ));
    }
    told.join("\n")
}

fn one(fault: &Fault, renderer: &Renderer) -> String {
    let mut group = Group::with_title(Level::ERROR.primary_title(fault.to_string()));
    if let Some(excerpt) = &fault.excerpt {
        let marked = AnnotationKind::Primary.span(excerpt.marked.clone());
        let snippet = Snippet::source(excerpt.text.as_str());
        group = group.element(snippet.line_start(fault.line).annotation(marked));
    }
    renderer.render(&[group])
}
