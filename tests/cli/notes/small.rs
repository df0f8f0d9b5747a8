//! The sentence above the charts of a page: the settings of their circuit.

use motion_rtl::registry::Entry;
use motion_rtl::trace::chart::parse;
use std::collections::{BTreeMap, BTreeSet};

/// The settings in which the circuit of the charts of `text` differs from the full one. If the charts
/// have different values, the value that at least half of them have.
pub fn sentence(entry: &Entry, text: &str) -> Result<String, String> {
    let name = entry.name;
    let keys = entry.keys().into_iter();
    let small: BTreeMap<_, _> = keys
        .filter(|key| key.small != key.full)
        .map(|key| (key.name, key.small.unwrap_or_else(|| "unset".into())))
        .collect();
    let charts = parse(text).map_err(|error| error.to_string())?;
    let charts = charts.into_iter().filter(|chart| chart.circuit == name);
    let charts: Vec<BTreeMap<_, _>> = charts
        .map(|chart| {
            let changed = chart.pairs.into_iter().map(|pair| (pair.key, pair.value));
            small.clone().into_iter().chain(changed).collect()
        })
        .collect();
    let keys: BTreeSet<_> = charts.iter().flat_map(BTreeMap::keys).collect();
    let mut differ = false;
    let mut settings = Vec::new();
    for key in keys {
        let values: Vec<_> = charts.iter().map(|chart| chart.get(key)).collect();
        let times = |value: &Option<&String>| values.iter().filter(|one| *one == value).count();
        differ |= values.iter().any(|value| *value != values[0]);
        // Of values that are as frequent, the first.
        let most = values.iter().rev().max_by_key(|value| times(value));
        let often = most.is_some_and(|most| {
            let times = times(most);
            2 * times >= charts.len() && (times > 1 || charts.len() == 1)
        });
        if let Some(Some(value)) = most.filter(|_| often) {
            settings.push(format!("`{key}={value}`"));
        }
    }
    let list = match settings.split_last() {
        None if differ && !small.is_empty() => {
            let place = "The brackets in the first line of a chart of";
            return Ok(format!("{place} `{name}` show its settings.\n"));
        }
        None => return Err(format!("the charts of {name} have its full settings")),
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
    };
    let others = match differ {
        true => ", unless the brackets in their first line say otherwise",
        false => "",
    };
    Ok(format!("Charts of `{name}` use {list}{others}.\n"))
}

#[test]
fn settings_of_charts_are_those_that_most_have() {
    use motion_rtl::registry::find;
    let chart = |head: &str| format!("```chart {head} a title\ntick 0\n= a 0\n```\n");
    let said = |name, heads: &[&str]| {
        let text: String = heads.iter().map(|head| chart(head)).collect();
        sentence(find(name).unwrap(), &text)
    };
    let other = "unless the brackets in their first line say otherwise";
    assert_eq!(
        said("enable_counter", &["enable_counter", "sync_stage"]).unwrap(),
        "Charts of `enable_counter` use `width=3`.\n"
    );
    assert_eq!(
        said("enable_counter", &["enable_counter[width=4]"]).unwrap(),
        "Charts of `enable_counter` use `width=4`.\n"
    );
    let heads = ["stop_error", "stop_error[position=5]", "stop_error"];
    assert_eq!(
        said("stop_error", &heads).unwrap(),
        format!("Charts of `stop_error` use `position=4`, {other}.\n")
    );
    let heads = ["stop_error", "stop_error[sign=literal]"];
    assert_eq!(
        said("stop_error", &heads).unwrap(),
        format!("Charts of `stop_error` use `position=4`, {other}.\n")
    );
    let heads = ["stop_error[position=3]", "stop_error[position=5]"];
    assert_eq!(
        said("stop_error", &heads).unwrap(),
        "The brackets in the first line of a chart of `stop_error` show its settings.\n"
    );
    assert!(said("sync_stage", &["sync_stage"]).is_err());
}

#[test]
fn pages_list_the_settings_of_their_charts() {
    use super::{expect_none, notes};
    use motion_rtl::registry::CATALOGUE;
    let mut wrong = Vec::new();
    for note in notes() {
        let marks = |kind: &str, name: &str| {
            let mark = format!("<!-- begin generated: {kind} {name} -->");
            note.text.lines().any(|line| line == mark)
        };
        for entry in CATALOGUE {
            let lacks = marks("signals", entry.name) && !marks("charts", entry.name);
            if lacks && sentence(entry, &note.text).is_ok() {
                wrong.push(format!("{}: settings of {}", note.name, entry.name));
            }
        }
    }
    expect_none(&wrong);
}
