use super::*;
use std::sync::atomic::{AtomicBool, Ordering};

fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_has_its_name_only_when_committed() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let mut file = AtomicFile::create(&path).unwrap();
    file.write_all(b"new").unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(file.commit().unwrap(), path);
    assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    assert_eq!(names(directory.path()), ["a.txt"]);
}

#[test]
fn a_dropped_file_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let mut file = AtomicFile::create(directory.path().join("a.txt")).unwrap();
    file.write_all(b"half").unwrap();
    assert_eq!(names(directory.path()).len(), 1);
    drop(file);
    assert!(names(directory.path()).is_empty());
}

#[test]
fn a_failed_rename_leaves_nothing_and_names_the_path() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("taken");
    fs::create_dir_all(path.join("full")).unwrap();
    let error = write(&path, "text").unwrap_err();
    assert!(error.to_string().contains("taken"), "{error}");
    assert_eq!(names(directory.path()), ["taken"]);
}

#[test]
fn too_many_open_files_are_known_behind_a_path() {
    let error = io::Error::from_raw_os_error(libc::EMFILE);
    let path = Path::new("a");
    assert!(too_many_open(&error) && too_many_open(&named(path, &error)));
    for code in [libc::EACCES, libc::ENOENT] {
        let error = io::Error::from_raw_os_error(code);
        assert!(!too_many_open(&error) && !too_many_open(&named(path, &error)));
    }
}

#[test]
fn whole_files_may_bring_their_directory() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("new/a.txt");
    write(&path, "text").unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "text");
}

#[test]
fn a_directory_goes_again_where_it_stays_empty() {
    let outer = tempfile::tempdir().unwrap();
    let deep = outer.path().join("a/b/c");
    let directory = Directory::create(&deep).unwrap();
    assert!(deep.is_dir());
    drop(directory);
    assert!(names(outer.path()).is_empty());

    let directory = Directory::create(&deep).unwrap();
    fs::write(outer.path().join("a/x"), "").unwrap();
    drop(directory);
    assert_eq!(names(&outer.path().join("a")), ["x"]);

    let file = outer.path().join("a/x");
    let error = Directory::create(&file.join("y/z")).unwrap_err();
    assert!(error.to_string().contains("a/x/y/z: "), "{error}");
    let before = fs::read_dir(outer.path()).unwrap().count();
    drop(Directory::create(outer.path()).unwrap());
    assert_eq!(fs::read_dir(outer.path()).unwrap().count(), before);
}

#[cfg(unix)]
#[test]
fn a_link_stays_and_what_it_leads_to_is_written() {
    use std::os::unix::fs::symlink;
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    fs::create_dir(at("far")).unwrap();
    fs::write(at("far/old"), "old").unwrap();
    symlink("far/old", at("there")).unwrap();
    symlink(at("there"), at("by_two")).unwrap();
    symlink("far/new", at("not_yet")).unwrap();
    for (link, target) in [
        ("there", "far/old"),
        ("by_two", "far/old"),
        ("not_yet", "far/new"),
    ] {
        assert_eq!(write(at(link), link).unwrap(), at(link));
        assert!(at(link).is_symlink(), "{link}");
        assert!(!at(target).is_symlink(), "{link}");
        assert_eq!(fs::read_to_string(at(target)).unwrap(), link);
    }
    // The temporary file is in the directory in which the rename is one step.
    let file = AtomicFile::create(at("there")).unwrap();
    assert_eq!(names(&at("far")).len(), 3);
    drop(file);
    symlink("circle", at("circle")).unwrap();
    let error = write(at("circle"), "").unwrap_err().to_string();
    assert!(
        error.ends_with("circle: too many symbolic links"),
        "{error}"
    );
    let left = ["by_two", "circle", "far", "not_yet", "there"];
    assert_eq!(names(directory.path()), left);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_stays() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let directory = tempfile::tempdir().unwrap();
    let socket = directory.path().join("socket");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    let link = directory.path().join("link");
    symlink("socket", &link).unwrap();
    for path in [&socket, &link] {
        let error = write(path, "text").unwrap_err();
        let text = "is not a regular file, and only such a file is replaced";
        assert_eq!(error.to_string(), format!("{}: {text}", path.display()));
    }
    let kind = socket.symlink_metadata().unwrap().file_type();
    assert!(kind.is_socket());
    assert!(link.is_symlink());
    assert_eq!(names(directory.path()), ["link", "socket"]);
}

#[cfg(unix)]
#[test]
fn a_file_is_as_readable_as_any_other() {
    use std::os::unix::fs::PermissionsExt;
    let directory = tempfile::tempdir().unwrap();
    let ours = directory.path().join("ours");
    let plain = directory.path().join("plain");
    write(&ours, "").unwrap();
    fs::write(&plain, "").unwrap();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}

fn begin(directory: &Path, name: &str, text: &str) -> AtomicFile {
    let mut file = AtomicFile::create(directory.join(name)).unwrap();
    file.write_all(text.as_bytes()).unwrap();
    file
}

#[test]
fn where_one_cannot_be_named_the_older_ones_are_there_again() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    fs::write(path("a"), "old").unwrap();
    let all = ["a", "b", "c", "d"];
    let files = all.map(|name| begin(directory.path(), name, "new"));
    // Blocked only after the file was begun.
    fs::create_dir_all(path("c/full")).unwrap();
    let error = commit_all(files).unwrap_err().to_string();
    assert!(
        error.starts_with(&path("c").display().to_string()),
        "{error}"
    );
    assert_eq!(names(directory.path()), ["a", "c"]);
    assert_eq!(fs::read_to_string(path("a")).unwrap(), "old");
    fs::remove_dir_all(path("c")).unwrap();
    let files = all.map(|name| begin(directory.path(), name, "new"));
    assert_eq!(commit_all(files).unwrap(), all.map(path));
    assert_eq!(names(directory.path()), all);
    assert_eq!(fs::read_to_string(path("a")).unwrap(), "new");
}

#[test]
fn what_nobody_writes_any_more_is_removed() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    let others = [".motion-rtl-x.txt", ".other.part", "motion-rtl-x.part"];
    for name in others {
        fs::write(path(name), "").unwrap();
    }
    fs::create_dir(path(".motion-rtl-d.part")).unwrap();
    let file = begin(directory.path(), "a", "half");
    let claim = Claim::new(directory.path(), "a").unwrap().unwrap();
    assert!(clear(directory.path()).is_empty());
    for name in [".motion-rtl-x.part", ".motion-rtl-x.lock"] {
        fs::write(path(name), "").unwrap();
    }
    let removed = clear(directory.path());
    assert_eq!(removed, [path(".motion-rtl-x.part")]);
    assert_eq!(names(directory.path()).len(), others.len() + 3);
    file.commit().unwrap();
    drop(claim);
    assert_eq!(clear(directory.path()), [] as [PathBuf; 0]);
    assert_eq!(fs::read_to_string(path("a")).unwrap(), "half");
}

#[test]
fn a_stem_has_one_writer_at_a_time() {
    let directory = tempfile::tempdir().unwrap();
    let long = "\u{e9}".repeat(127);
    for stem in ["a", &long] {
        let claim = Claim::new(directory.path(), stem).unwrap().unwrap();
        let error = Claim::new(directory.path(), stem).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::ResourceBusy);
        let text = error.to_string();
        assert!(
            text.ends_with(": is being written by another run"),
            "{text}"
        );
        let other = Claim::new(directory.path(), "b").unwrap().unwrap();
        drop(claim);
        drop(Claim::new(directory.path(), stem).unwrap().unwrap());
        drop(other);
        assert!(names(directory.path()).is_empty());
    }
    // If no file can be created there is no claim; writing reports the reason.
    assert!(
        Claim::new(&directory.path().join("none"), "a")
            .unwrap()
            .is_none()
    );
}

/// A concurrent run never takes a file that is being written for a left-over one.
#[test]
fn files_that_are_only_just_begun_are_no_leftovers() {
    let directory = tempfile::tempdir().unwrap();
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let clearing = [(); 2].map(|()| {
            scope.spawn(|| {
                let mut removed = Vec::new();
                while !over.load(Ordering::Relaxed) {
                    removed.extend(clear(directory.path()));
                }
                removed
            })
        });
        let write = |name: &String| {
            begin(directory.path(), name, name).commit()?;
            fs::read_to_string(directory.path().join(name))
        };
        let names: Vec<_> = (0..300).map(|k: u32| k.to_string()).collect();
        let wrong = names
            .iter()
            .find(|name| write(name).ok().as_ref() != Some(name));
        over.store(true, Ordering::Relaxed);
        assert_eq!(wrong, None);
        for removed in clearing {
            assert_eq!(removed.join().unwrap(), [] as [PathBuf; 0]);
        }
    });
}

/// Runs with different stems replace the same files, and each clears before it begins.
#[test]
fn runs_side_by_side_see_no_leftovers_and_no_other_writer() {
    let directory = tempfile::tempdir().unwrap();
    let run = |stem: &str| -> io::Result<()> {
        for _ in 0..100 {
            let claim = Claim::new(directory.path(), stem)?;
            assert!(claim.is_some());
            assert_eq!(clear(directory.path()), [] as [PathBuf; 0]);
            let files = ["a", "b"].map(|name| begin(directory.path(), name, name));
            commit_all(files)?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let runs = ["k", "l", "m"].map(|stem| scope.spawn(move || run(stem)));
        for run in runs {
            run.join().unwrap().unwrap();
        }
    });
    assert_eq!(names(directory.path()), ["a", "b"]);
    assert_eq!(fs::read(directory.path().join("b")).unwrap(), b"b");
}

/// A left-over claim is taken over by the next run, or removed, silently.
#[test]
fn claims_that_were_left_are_in_nobodys_way() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join(".motion-rtl-a.lock");
    fs::write(&path, "").unwrap();
    drop(Claim::new(directory.path(), "a").unwrap().unwrap());
    assert!(names(directory.path()).is_empty());
    // A mere reader is not a writer.
    let look = || {
        fs::write(&path, "").unwrap();
        let looks = fs::File::open(&path).unwrap();
        looks.lock_shared().unwrap();
        looks
    };
    let looks = look();
    assert_eq!(clear(directory.path()), [] as [PathBuf; 0]);
    assert!(names(directory.path()).is_empty());
    drop(looks);
    let looks = look();
    let wait = std::time::Duration::from_millis(50);
    std::thread::scope(|scope| {
        let claimed = scope.spawn(|| Claim::new(directory.path(), "a").map(drop));
        std::thread::sleep(wait);
        drop(looks);
        claimed.join().unwrap().unwrap();
    });
    assert!(names(directory.path()).is_empty());
    // One run clears at a time.
    let other = Claim::new(directory.path(), "").unwrap().unwrap();
    let left = directory.path().join(".motion-rtl-x.part");
    fs::write(&left, "").unwrap();
    assert_eq!(clear(directory.path()), [] as [PathBuf; 0]);
    drop(other);
    assert_eq!(clear(directory.path()), [left]);
}

/// Leaves a claim as a killed run does; a held claim stays as it is.
fn leave_claim(directory: &Path) {
    let path = directory.join(".motion-rtl-a.lock");
    let mut options = fs::File::options();
    let _ = options.write(true).create(true).truncate(false).open(path);
}

/// Clearing a directory never counts as writing.
#[test]
fn who_clears_away_is_no_writer() {
    let directory = tempfile::tempdir().unwrap();
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while !over.load(Ordering::Relaxed) {
                    clear(directory.path());
                }
            });
        }
        let refused = (0..1000).find_map(|_| {
            leave_claim(directory.path());
            let claim = Claim::new(directory.path(), "a");
            claim.err().map(|error| error.to_string())
        });
        over.store(true, Ordering::Relaxed);
        assert_eq!(refused, None);
    });
}

/// However many threads claim a stem and clear the directory, one of them has the claim.
#[test]
fn a_claim_is_never_held_twice() {
    let directory = tempfile::tempdir().unwrap();
    let held = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| {
                for _ in 0..1000 {
                    leave_claim(directory.path());
                    clear(directory.path());
                    let Ok(claim) = Claim::new(directory.path(), "a") else {
                        continue;
                    };
                    assert!(!held.swap(true, Ordering::SeqCst), "held twice");
                    std::thread::yield_now();
                    held.store(false, Ordering::SeqCst);
                    drop(claim);
                }
            });
        }
    });
    clear(directory.path());
    assert!(names(directory.path()).is_empty());
}

/// Two files of one name in turn: only the one that is open gets a second name.
#[test]
fn a_file_that_is_replaced_meanwhile_gets_no_second_name() {
    let directory = tempfile::tempdir().unwrap();
    let target = directory.path().join("a");
    fs::write(&target, "old").unwrap();
    let held = fs::File::open(&target).unwrap();
    write(&target, "new").unwrap();
    assert_eq!(naming::second(&target, Some(&held)), Some(None));
    assert_eq!(names(directory.path()), ["a"]);
    let held = fs::File::open(&target).unwrap();
    let second = naming::second(&target, Some(&held)).unwrap().unwrap();
    assert_eq!(fs::read_to_string(second).unwrap(), "new");
}

/// A file that a run has made but not locked yet is left over only when it is old.
#[test]
fn what_is_too_young_to_be_locked_stays() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join(".motion-rtl-x.new");
    let file = fs::File::create(&path).unwrap();
    assert_eq!(clear(directory.path()), [] as [PathBuf; 0]);
    let age = |age: std::time::Duration| {
        let made = std::time::SystemTime::now() - age;
        file.set_modified(made).unwrap();
    };
    age(hidden::STALE / 2);
    assert_eq!(clear(directory.path()), [] as [PathBuf; 0]);
    age(hidden::STALE);
    file.lock().unwrap();
    assert_eq!(clear(directory.path()), [] as [PathBuf; 0]);
    file.unlock().unwrap();
    assert_eq!(clear(directory.path()), [path]);
}

#[cfg(unix)]
#[test]
fn links_are_no_claims_and_are_not_followed() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    for target in ["nowhere", "there"] {
        fs::write(at("there"), "text").unwrap();
        std::os::unix::fs::symlink(target, at(".motion-rtl-a.lock")).unwrap();
        let error = Claim::new(directory.path(), "a").unwrap_err();
        let text = "is not a regular file, and locks need one of this name";
        let path = at(".motion-rtl-a.lock");
        assert_eq!(error.to_string(), format!("{}: {text}", path.display()));
        assert!(clear(directory.path()).is_empty());
        assert_eq!(names(directory.path()), [".motion-rtl-a.lock", "there"]);
        fs::remove_file(path).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn a_directory_that_is_a_link_to_nothing_says_so() {
    let outer = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink("nowhere", outer.path().join("link")).unwrap();
    let error = Directory::create(&outer.path().join("link/deep")).unwrap_err();
    let text = format!(
        "{}: is a link to what is not there",
        outer.path().join("link").display()
    );
    assert_eq!(error.to_string(), text);
}
