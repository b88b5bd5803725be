//! Checks every exercise with correct answers in several notations, with its known mistakes, and
//! with an unrecognized wrong answer.
//!
//! The answers here are written by hand, and the crates compute the correct values.

mod cases;

use cases::{CHAPTER, Case, OWN};
use explorer::exercise::{Verdict, exercises, find_exercise};
use std::collections::BTreeMap;

fn check(number: u32, answer: &str) -> Verdict {
    let exercise = find_exercise(number).expect("an exercise");
    exercise.check(answer).expect(answer)
}

fn cases() -> impl Iterator<Item = &'static Case> {
    CHAPTER.iter().chain(&OWN)
}

/// C38 to C47 and C104: answers to the exercises of the chapter and of this project.
#[test]
fn correct_answers_are_accepted_in_several_notations() {
    for Case { number, right, .. } in cases() {
        assert!(right.len() >= 2, "{number}");
        for answer in *right {
            let verdict = check(*number, answer);
            assert!(verdict.is_right(), "{number}, {answer}: {}", verdict.sentence().en);
        }
    }
    let numbers = exercises().iter().map(|exercise| exercise.number);
    assert!(numbers.eq(1..=24) && cases().map(|case| case.number).eq(1..=24));
}

#[test]
fn every_mistake_has_a_distinct_message() {
    for Case { number, mistaken, .. } in cases() {
        let mut told = BTreeMap::new();
        for (answer, id) in *mistaken {
            let verdict = check(*number, answer);
            let said = verdict.sentence();
            let Verdict::Mistaken(mistake) = verdict else {
                panic!("{number}, {answer}: {}", said.en);
            };
            assert_eq!(mistake.id, *id, "{number}, {answer}");
            assert!(said.en.starts_with("incorrect: ") && said.zh.starts_with("不对："));
            let id = told.entry((said.en, said.zh)).or_insert(*id);
            assert_eq!(*id, mistake.id, "{number}, {answer}: two mistakes have the same message");
        }
        let all = &find_exercise(*number).expect("an exercise").mistakes;
        assert_eq!(told.len(), all.len(), "{number}: some mistakes are not tested");
    }
}

#[test]
fn unrecognized_wrong_answers_are_compared_entry_by_entry() {
    for Case { number, unknown: (answer, part), .. } in cases() {
        let verdict = check(*number, answer);
        assert!(matches!(verdict, Verdict::Different { .. }), "{number}: {verdict:?}");
        let said = verdict.sentence();
        assert!(
            said.en.starts_with("incorrect") && said.en.contains(part),
            "{number}: {}",
            said.en
        );
        assert!(said.zh.starts_with("不对："), "{number}: {}", said.zh);
    }
}

#[test]
fn rounded_answers_are_flagged_and_invalid_answers_rejected() {
    for (number, answer) in [(16, "3.81"), (14, "2.732, 2"), (23, "2.615"), (24, "0.2001")] {
        let verdict = check(number, answer);
        assert!(matches!(verdict, Verdict::Rounded), "{number}, {answer}: {verdict:?}");
        let said = verdict.sentence();
        assert!(said.en.starts_with("incorrect: ") && said.en.contains("at least ten digits"));
    }
    for (number, answer, part) in [
        (8, "1 0 0 0; 0 1 0 0; 0 0 3 -2", "4 + 4 + 4 entries instead of 4 + 4 + 4 + 4"),
        (12, "1, -3", "2 entries instead of 3: enter `x, y, z`"),
        (3, "A=n+f", "`B`"),
        (3, "A=n+g; B=1", "the symbols are n, f"),
        (
            2,
            "nx/(r-l) 0 0 -1/2 - l nx/(r-l); 0 ny/(t-b) 0 -1/2 - b ny/(t-b); 0 0 2/(n-f) -(n+f)/(n-f); 0 0 0 1",
            "5 + 5 + 4 + 4 entries instead of 4 + 4 + 4 + 4: enter a 4 × 4 matrix, its rows separated by `;`, in terms of nx, ny, l, r, b, t, n, f; spaces separate entries, so write `l*nx` or put commas",
        ),
        (2, "f_n, 1", "write `f*n`"),
        (5, "1 + (a, b, c, 1)", "write out every entry"),
        (
            6,
            "f 0 0 0; 0 f 0 0; 0 0 0 n*f; 0 0 -1 n+f; c=n*f",
            "enter only the matrix, without `c=n*f`",
        ),
        (
            10,
            "u=(0,0,1); v=(1,0,0); w=(0,1,0); M=[0 0 1 0; 1 0 0 0; 0 1 0 -1; 0 0 0 1]",
            "enter only the matrix, without `u=(0,0,1)`",
        ),
        (6, "Q=[f,0,0,0;0,f,0,0;0,0,0,nf;0,0,-1,n+f], c=nf", "without `c=nf`"),
        (6, "1/n [f 0 0 0; 0 f 0 0; 0 0 0 f n; 0 0 -1 n+f]", "write `n*f` or put commas"),
        (7, "n", "1 entry instead of 4"),
        (14, "1+2cos30°, 2", "write `cos(30°)`"),
        (12, "x, y, z", "only numbers"),
        (16, "1/0", "not a finite number"),
        (16, "", "empty"),
    ] {
        let error = find_exercise(number).expect("an exercise").check(answer);
        let error = error.expect_err(answer);
        assert!(error.to_string().contains(part), "{number}, {answer}: {error}");
        assert!(!error.message.zh.is_empty());
    }
    assert!(find_exercise(0).is_none() && find_exercise(25).is_none());
}

#[test]
fn chinese_verdicts_name_the_entry_without_stray_spaces() {
    for (number, answer, said) in [
        (20, "125, 36", "不对：你的 y 等于 36"),
        (22, "13", "不对：你的像素数等于 13"),
        (19, "20", "不对：你的区域码等于 20"),
        (21, "100 0 -190; 0 50 -30; 0 1 1", "不对：你的第 3 行第 2 列等于 1"),
        (3, "n+f, 2f", "不对：取 n = -1，f = -5 时，你的 B 等于 -10"),
        (20, "1, 2", "不对：2 个元素中错了 2 个：你的 x 等于 1；你的 y 等于 2"),
        (12, "1, -3, 2", "不对：你的 z 等于 2，只有符号不对"),
        (
            9,
            "x, y, 3z-2, z; x/z, y/z, 1",
            "不对：取 x = 1，y = 2，z = 4 时，你的第 2 部分的 z 等于 1",
        ),
    ] {
        assert_eq!(check(number, answer).sentence().zh, said, "{number}, {answer}");
    }
    for (number, form) in [(22, "`像素数`"), (19, "`区域码`"), (9, "`x, y, z, w; x, y, z`")] {
        let said = find_exercise(number).expect("an exercise").form();
        assert!(said.zh.starts_with(form), "{number}: {}", said.zh);
    }
}

/// OpenGL's third row maps n and f to the same depths whether it is copied or written with N = −n
/// and F = −f.
#[test]
fn third_rows_in_exercise_2_map_near_and_far_as_the_verdicts_state() {
    let depths = |row: fn(f64, f64) -> [f64; 2]| {
        let (n, f) = (-1.0, -5.0);
        let [scale, offset] = row(n, f);
        [scale * n + offset, scale * f + offset]
    };
    assert_eq!(depths(|n, f| [2.0 / (n - f), -(n + f) / (n - f)]), [1.0, -1.0]);
    assert_eq!(depths(|n, f| [2.0 / (f - n), -(n + f) / (f - n)]), [-1.0, 1.0], "depth-reversed");
    let copied = depths(|n, f| [-2.0 / (f - n), -(n + f) / (f - n)]);
    assert_eq!(copied, depths(|n, f| [2.0 / (n - f), (n + f) / (n - f)]), "opengl-distances");
    assert_ne!(copied, [1.0, -1.0]);
}

/// Whether text contains a Han character.
fn is_chinese(text: &str) -> bool {
    text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c))
}

#[test]
fn all_text_is_in_both_languages() {
    for exercise in exercises() {
        let number = exercise.number;
        let form = exercise.form();
        assert!(!exercise.hints.is_empty() && exercise.mistakes.len() >= 3, "{number}");
        let mut texts = vec![(exercise.question.en, exercise.question.zh), (&*form.en, &*form.zh)];
        texts.extend(exercise.hints.iter().map(|hint| (hint.en, hint.zh)));
        texts.extend(exercise.mistakes.iter().map(|each| (each.sentence.en, each.sentence.zh)));
        for (en, zh) in texts {
            assert!(!is_chinese(en) && en.len() > 4, "{number}: {en}");
            // Text that is only a formula is the same in both languages.
            assert!(is_chinese(zh) || en == zh || !zh.is_ascii(), "{number}: {zh}");
            assert!(!zh.contains(['.', ';', '?']) || zh.contains('`') || is_chinese(zh), "{zh}");
            for half in [", ", "; ", ": "] {
                let between_han = zh.match_indices(half).any(|(at, _)| {
                    zh[..at].chars().next_back().is_some_and(|c| is_chinese(&c.to_string()))
                });
                assert!(
                    !between_han,
                    "{number}: half-width `{half}` after a Han character in {zh}"
                );
            }
        }
    }
}
