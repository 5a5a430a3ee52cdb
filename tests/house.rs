//! The house: what may use what. The floors are the table at the head of `src/lib.rs`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A source file of the library: its module path (`behavior::search`) and what it says outside its tests.
struct Source {
    module: String,
    text: String,
}

/// All files of the library; a test module at a file's end may see more than the code that it tests.
fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    collect(&root, &root, &mut found);
    found.sort_by(|a, b| a.module.cmp(&b.module));
    found
}

fn collect(root: &Path, folder: &Path, found: &mut Vec<Source>) {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths: BTreeSet<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    for path in paths {
        let inside = path.strip_prefix(root).expect("below the root").with_extension("");
        let name = inside.to_string_lossy().replace('/', "::");
        if path.is_dir() && name != "bin" {
            collect(root, &path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") && name != "lib" {
            let text = std::fs::read_to_string(&path).expect("UTF-8");
            let text = text.split("\n#[cfg(test)]\n").next().unwrap_or_default().to_string();
            let module = name.strip_suffix("::mod").unwrap_or(&name).to_string();
            if !module.ends_with("::tests") {
                found.push(Source { module, text });
            }
        }
    }
}

/// What a file imports or names, as whole paths from the crate's root, with the line.
fn uses(source: &Source) -> Vec<(usize, String)> {
    let mut paths = Vec::new();
    let statement = source.text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let mut pending: Option<(usize, String)> = None;
    for (number, line) in statement.enumerate() {
        let trimmed = line.trim_start();
        let begins = trimmed.starts_with("use ") || (trimmed.starts_with("pub") && trimmed.contains(" use "));
        match &mut pending {
            Some((_, text)) => text.push_str(line),
            None if begins => pending = Some((number + 1, line.to_string())),
            None => paths.extend(inline(line).map(|path| (number + 1, path))),
        }
        if pending.as_ref().is_some_and(|(_, text)| text.contains(';')) {
            let (at, text) = pending.take().expect("pending");
            let tree = text.split(" use ").last().unwrap_or_default().trim_start_matches("use ").trim();
            expand("", tree.trim_end_matches(';'), &mut |path| paths.push((at, path)));
        }
    }
    paths.into_iter().filter_map(|(at, path)| Some((at, absolute(&path, &source.module)?))).collect()
}

/// Paths from the crate's root that stand in a line of code.
fn inline(line: &str) -> impl Iterator<Item = String> {
    line.match_indices("crate::").map(|(at, _)| {
        line[at..].chars().take_while(|c| c.is_alphanumeric() || matches!(c, '_' | ':')).collect::<String>()
    })
}

/// Every path of a tree of imports.
fn expand(prefix: &str, tree: &str, found: &mut impl FnMut(String)) {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else {
        let name = tree.split(" as ").next().unwrap_or_default().trim();
        return found(format!("{prefix}{name}"));
    };
    let inner = &tree[open + 1..tree.rfind('}').expect("closed")];
    let prefix = format!("{prefix}{}", &tree[..open]);
    let (mut depth, mut from) = (0, 0);
    for (at, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                expand(&prefix, &inner[from..at], found);
                from = at + 1;
            }
            _ => {}
        }
    }
    if !inner[from..].trim().is_empty() {
        expand(&prefix, &inner[from..], found);
    }
}

/// A path without `crate::` and `super::`; nothing for what comes from another crate.
fn absolute(path: &str, module: &str) -> Option<String> {
    if let Some(path) = path.strip_prefix("crate::") {
        return Some(path.to_string());
    }
    let mut home: Vec<&str> = module.split("::").collect();
    let mut rest = path;
    rest.starts_with("super::").then_some(())?;
    while let Some(outer) = rest.strip_prefix("super::") {
        home.pop();
        rest = outer;
    }
    home.push(rest);
    Some(home.join("::"))
}

/// The rooms from the top floor down, as `src/lib.rs` lists them.
fn floors() -> Vec<String> {
    let library = include_str!("../src/lib.rs");
    let rows = library.lines().filter_map(|line| line.strip_prefix("//! | [`"));
    rows.map(|row| row.split('`').next().expect("a name").to_string()).collect()
}

fn room(path: &str) -> &str {
    path.split("::").next().unwrap_or_default()
}

#[test]
fn every_room_stands_in_the_table_of_the_library() {
    let listed: BTreeSet<String> = floors().into_iter().collect();
    let there: BTreeSet<String> = sources().iter().map(|source| room(&source.module).to_string()).collect();
    assert_eq!(listed, there);
}

#[test]
fn no_room_uses_one_above_it_so_none_that_steers_a_robot_can_name_the_truth() {
    let floors = floors();
    let level = |name: &str| floors.iter().position(|floor| floor == name);
    let mut wrong = Vec::new();
    for source in sources() {
        let own = level(room(&source.module)).expect("listed");
        for (line, path) in uses(&source) {
            if level(room(&path)).is_some_and(|other| other < own) {
                wrong.push(format!("{} line {line}: {path}", source.module));
            }
        }
    }
    assert!(wrong.is_empty(), "these run up the list of src/lib.rs:\n{}", wrong.join("\n"));
}

/// Which file a path leads to: the longest module of that name, or the one from which that room hands the name on.
fn file_of(path: &str, modules: &BTreeSet<String>, exports: &BTreeMap<String, String>) -> Option<String> {
    // A name may be handed on more than once, but hardly more often than this.
    const HANDED_ON: usize = 5;
    let mut path = path;
    for _ in 0..HANDED_ON {
        path = exports.get(path).map_or(path, String::as_str);
    }
    let mut ends = path.match_indices("::").map(|(at, _)| &path[..at]).collect::<Vec<_>>();
    ends.push(path);
    ends.into_iter().rev().find(|module| modules.contains(*module)).map(str::to_string)
}

/// The names that rooms hand on from their files: path → where it is from.
fn exports(sources: &[Source]) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for source in sources {
        for statement in source.text.split(';') {
            let Some((_, tree)) =
                statement.rsplit_once("pub use ").or_else(|| statement.rsplit_once("pub(super) use "))
            else {
                continue;
            };
            expand("", tree, &mut |path| {
                let from = absolute(&path, &source.module).unwrap_or_else(|| format!("{}::{path}", source.module));
                let name = path.rsplit("::").next().unwrap_or_default();
                found.insert(format!("{}::{name}", source.module), from);
            });
        }
    }
    found
}

#[test]
fn no_two_files_lean_on_each_other() {
    let sources = sources();
    let modules: BTreeSet<String> = sources.iter().map(|source| source.module.clone()).collect();
    let exports = exports(&sources);
    let mut arrows: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for source in &sources {
        let to = uses(source).into_iter().filter_map(|(_, path)| file_of(&path, &modules, &exports));
        // A room's own head lists its files; what a file takes from the head is of the head.
        let to = to.filter(|to| *to != source.module && !to.starts_with(&format!("{}::", source.module)));
        arrows.insert(&source.module, to.collect());
    }
    let circles: Vec<String> = arrows.keys().filter_map(|start| circle(start, &arrows)).collect();
    assert!(circles.is_empty(), "circles:\n{}", circles.join("\n"));
}

/// The shortest way from a file back to itself.
fn circle(start: &str, arrows: &BTreeMap<&str, BTreeSet<String>>) -> Option<String> {
    let mut ways = std::collections::VecDeque::from([vec![start.to_string()]]);
    let mut seen = BTreeSet::new();
    while let Some(way) = ways.pop_front() {
        for next in arrows.get(way.last()?.as_str()).into_iter().flatten() {
            if next == start {
                return Some(format!("{} → {start}", way.join(" → ")));
            }
            if seen.insert(next.clone()) {
                ways.push_back(way.iter().cloned().chain([next.clone()]).collect());
            }
        }
    }
    None
}

/// The public functions of a file that can fail and do not say of what: `line N: name`.
fn silent_about_errors(source: &Source) -> Vec<String> {
    let lines: Vec<&str> = source.text.lines().collect();
    let begins = |line: &str| line.trim_start().strip_prefix("pub fn ").map(|rest| rest.to_string());
    let mut silent = Vec::new();
    for (at, rest) in lines.iter().enumerate().filter_map(|(at, line)| Some((at, begins(line)?))) {
        let length = lines[at..].iter().position(|line| line.ends_with('{')).unwrap_or(0);
        let signature = lines[at..=at + length].concat();
        let answer = signature.rsplit(") -> ").next().filter(|_| signature.contains(") -> ")).unwrap_or_default();
        let kind = answer.split('<').next().unwrap_or_default().trim_end_matches([' ', '{']);
        let documented = |line: &&&str| matches!(line.trim_start().get(..2), Some("//" | "#["));
        let mut doc = lines[..at].iter().rev().take_while(documented);
        if kind.rsplit("::").next().is_some_and(|name| name.ends_with("Result")) && !doc.any(|l| l.contains("# Errors"))
        {
            silent.push(format!("{} line {}: {}", source.module, at + 1, rest.split('(').next().unwrap_or_default()));
        }
    }
    silent
}

#[test]
fn every_public_function_that_can_fail_says_of_what() {
    let silent: Vec<String> = sources().iter().flat_map(silent_about_errors).collect();
    assert!(silent.is_empty(), "these want a section `# Errors`:\n{}", silent.join("\n"));
}
