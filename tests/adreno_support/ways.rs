//! How many instructions a wave that is a formula takes: ways through the innermost loop of a stage, read in the driver's
//! assembly.
use std::collections::HashMap;

struct Line {
    word: String,
    /// Repetitions and waits that are part of it included.
    instructions: i64,
    /// Of a branch.
    target: Option<usize>,
}

/// Fewest and most instructions once around the innermost loop of a stage; zeros where it has none. The stage has
/// `instructions`, as the driver counts them: whoever reads otherwise has misread.
pub fn around(assembly: &str, instructions: i64) -> [i64; 2] {
    let lines = read(assembly);
    let counted: i64 = lines.iter().map(|line| line.instructions).sum();
    assert_eq!(counted, instructions, "instructions of this assembly:\n{assembly}");
    let back = (0..lines.len())
        .filter_map(|end| lines[end].target.filter(|&head| head <= end).map(|head| (head, end)));
    let back: Vec<_> = back.collect();
    let innermost = back.iter().filter(|a| !back.iter().any(|b| a != &b && a.0 <= b.0 && b.1 <= a.1));
    let ways = innermost.map(|&(head, end)| ways(&lines, head, end));
    ways.fold([0; 2], |all, one| if one[1] > all[1] { one } else { all })
}

/// Branches lead forwards, but for the one at `end`: so from there backwards, each line knows the ways from itself.
fn ways(lines: &[Line], head: usize, end: usize) -> [i64; 2] {
    let mut from: Vec<Option<[i64; 2]>> = vec![None; end + 2 - head];
    for at in (head..=end).rev() {
        let line = &lines[at];
        let next = (at < end && line.word != "jump").then(|| from[at + 1 - head]).flatten();
        let led = line.target.filter(|&target| at < target && target <= end);
        let led = led.and_then(|target| from[target - head]);
        let rest = match (next, led) {
            _ if at == end => Some([0; 2]),
            (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
            (one, other) => one.or(other),
        };
        from[at - head] = rest.map(|ways| ways.map(|way| way + line.instructions));
    }
    from[0].unwrap_or_default()
}

/// The main part: what runs once for all threads, and the padding behind the end, the driver does not count.
fn read(assembly: &str) -> Vec<Line> {
    let (mut lines, mut labels, mut preamble) = (Vec::new(), HashMap::new(), None);
    for text in assembly.lines().map(|text| text.split(';').next().unwrap_or_default().trim()) {
        if let Some(label) = text.strip_prefix('l').and_then(|text| text.strip_suffix(':')) {
            labels.insert(label, lines.len());
            continue;
        }
        let (mut rest, mut instructions) = (text, 1);
        while let Some((flag, behind)) = rest.strip_prefix('(').and_then(|rest| rest.split_once(')')) {
            let more = ["rpt", "nop"].iter().find_map(|name| flag.strip_prefix(name)?.parse::<i64>().ok());
            instructions += more.unwrap_or(0);
            rest = behind.trim_start();
        }
        let word = rest.split(' ').next().unwrap_or_default();
        if !word.starts_with(|first: char| first.is_ascii_lowercase()) {
            continue;
        }
        // Two moves in one.
        instructions += i64::from(word.starts_with("swz."));
        let target = text.split_once(" #l").map(|(_, label)| label);
        if word == "shps" {
            preamble = target;
        }
        lines.push((word, instructions, target));
        if word == "end" {
            break;
        }
    }
    let begin = preamble.map_or(0, |label| labels[label]);
    let line = |&(word, instructions, target): &(&str, i64, Option<&str>)| Line {
        word: word.to_owned(),
        instructions,
        target: target.map(|label| labels[label] - begin),
    };
    lines[begin..].iter().map(line).collect()
}
