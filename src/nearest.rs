//! The name that was meant by a mistyped one.

/// Returns the name nearest to `wanted`, if at most a third of its letters differ. Case and the
/// difference between `-` and `_` do not count; two swapped letters are one difference.
pub fn nearest<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |name: &str| name.to_lowercase().replace('-', "_");
    let wanted = plain(wanted);
    let distances = names.into_iter().map(|name| {
        let distance = strsim::osa_distance(&wanted, &plain(name));
        (distance, name)
    });
    let (distance, name) = distances.min_by_key(|(distance, _)| *distance)?;
    let most = name.chars().count().max(wanted.chars().count()) / 3;
    (distance <= most).then_some(name)
}

/// Returns "; did you mean X?" with the nearest name, for the end of a problem; nothing if none is
/// near enough.
pub fn did_you_mean<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    meant(nearest(wanted, names))
}

/// Returns "; did you mean X?" for a name that was found near, or nothing.
pub fn meant(near: Option<&str>) -> String {
    near.map_or_else(String::new, |near| format!("; did you mean {near}?"))
}

/// Returns the paths most similar to `wanted`, at most `most`, the nearest first: by what is behind
/// the last dot, then as a whole.
pub fn nearest_paths<'a>(
    wanted: &str,
    paths: impl IntoIterator<Item = &'a str>,
    most: usize,
) -> Vec<String> {
    fn last(path: &str) -> &str {
        path.rsplit('.').next().unwrap_or(path)
    }
    let distances = paths.into_iter().map(|path| {
        let of_last = strsim::osa_distance(last(wanted), last(path));
        (of_last, strsim::osa_distance(wanted, path), path)
    });
    let mut ranked: Vec<_> = distances.collect();
    ranked.sort_unstable();
    ranked.truncate(most);
    let ranked = ranked.into_iter().map(|(.., path)| path.to_owned());
    ranked.collect()
}

#[cfg(test)]
mod tests {
    use super::{nearest, nearest_paths};

    #[test]
    fn the_nearest_paths_come_first() {
        let paths = [
            "top.count",
            "top.a.counter",
            "top.phase",
            "top.x",
            "top.y",
            "top.z",
        ];
        let near = nearest_paths("top.cuont", paths, 5);
        assert_eq!(near[0], "top.count");
        assert_eq!(near.len(), 5);
    }

    #[test]
    fn a_third_of_the_letters_may_differ() {
        let names = ["position", "speed", "step", "cks", "x"];
        let of = |wanted| nearest(wanted, names);
        assert_eq!(of("postion"), Some("position"));
        assert_eq!(of("psoition"), Some("position"));
        assert_eq!(of("Step"), Some("step"));
        assert_eq!(of("spede"), Some("speed"));
        assert_eq!(of("ck"), Some("cks"));
        assert_eq!(of("y"), None);
        assert_eq!(of("voltage"), None);
        assert_eq!(nearest("lead-angle", ["lead_angle"]), Some("lead_angle"));
        assert_eq!(nearest("a", []), None);
    }

    #[test]
    fn of_equally_near_names_the_first_counts() {
        assert_eq!(nearest("rata", ["rate", "data"]), Some("rate"));
    }
}
