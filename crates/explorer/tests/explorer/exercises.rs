//! Every exercise with right answers in several notations, its named wrong answers, and one that
//! nobody gives.
//!
//! The answers are written here by hand, and what is right is computed by the crates.

use explorer::exercise::{Verdict, exercises, find_exercise};
use std::collections::BTreeSet;

/// Right answers, and wrong ones with the names of their mistakes.
struct Case {
    number: u32,
    right: &'static [&'static str],
    mistaken: &'static [(&'static str, &'static str)],
    /// A wrong answer without a name, and what is said about it.
    unknown: (&'static str, &'static str),
}

const CHAPTER: [Case; 11] = [
    Case {
        number: 1,
        right: &[
            "nx/2 0 0 (nx-1)/2; 0 -ny/2 0 (ny-1)/2; 0 0 1 0; 0 0 0 1",
            "[[n_x/2, 0, 0, n_x/2 - 1/2], [0, −½·n_y, 0, (n_y − 1)/2], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ],
        mistaken: &[
            ("nx/2 0 0 (nx-1)/2; 0 ny/2 0 (ny-1)/2; 0 0 1 0; 0 0 0 1", "rows-from-the-bottom"),
            ("nx/2 0 0 nx/2; 0 -ny/2 0 ny/2; 0 0 1 0; 0 0 0 1", "centers-at-halves"),
            ("nx/2 0 0 (nx-1)/2; 0 -ny/2 0 (1-ny)/2; 0 0 1 0; 0 0 0 1", "offset-of-y-negated"),
            ("ny/2 0 0 (ny-1)/2; 0 -nx/2 0 (nx-1)/2; 0 0 1 0; 0 0 0 1", "sizes-exchanged"),
            ("nx/2 0 0 (nx-1)/2; 0 -ny/2 0 (ny-1)/2; 0 0 0 0; 0 0 0 1", "z-lost"),
            ("nx/2 0 0 0; 0 -ny/2 0 0; 0 0 1 0; (nx-1)/2 (ny-1)/2 0 1", "transposed"),
        ],
        unknown: (
            "nx/2 0 0 (nx-1)/2; 0 -ny/2 0 ny; 0 0 -1 0; 0 0 0 1",
            "2 of 16 entries are not right for nx = 640, ny = 480: row 2, column 4 is 480; row 3, column 3 is -1, only its sign is wrong",
        ),
    },
    Case {
        number: 2,
        right: &[
            "nx/(r-l) 0 0 -1/2-l*nx/(r-l); 0 ny/(t-b) 0 -1/2-b*ny/(t-b); 0 0 2/(n-f) -(n+f)/(n-f); 0 0 0 1",
            "nx/(r-l), 0, 0, (nx-1)/2 - nx (r+l)/(2(r-l)); 0, ny/(t-b), 0, (ny-1)/2 - ny (t+b)/(2(t-b)); 0, 0, -2/(f-n), (n+f)/(f-n); 0, 0, 0, 1",
        ],
        mistaken: &[
            (
                "nx/(r-l) 0 0 -l*nx/(r-l); 0 ny/(t-b) 0 -b*ny/(t-b); 0 0 2/(n-f) -(n+f)/(n-f); 0 0 0 1",
                "centers-at-halves",
            ),
            (
                "nx/(r-l) 0 0 (nx-1)/(r-l)-(r+l)/(r-l); 0 ny/(t-b) 0 (ny-1)/(t-b)-(t+b)/(t-b); 0 0 2/(n-f) -(n+f)/(n-f); 0 0 0 1",
                "order-exchanged",
            ),
            (
                "2/(r-l) 0 0 -(r+l)/(r-l); 0 2/(t-b) 0 -(t+b)/(t-b); 0 0 2/(n-f) -(n+f)/(n-f); 0 0 0 1",
                "viewport-forgotten",
            ),
            (
                "nx/(r-l) 0 0 -1/2-l*nx/(r-l); 0 ny/(t-b) 0 -1/2-b*ny/(t-b); 0 0 -2/(n-f) (n+f)/(n-f); 0 0 0 1",
                "near-and-far-exchanged",
            ),
            (
                "nx/(r-l) 0 0 -1/2-l*nx/(r-l); 0 ny/(t-b) 0 -1/2-b*ny/(t-b); 0 0 2/(n-f) (n+f)/(n-f); 0 0 0 1",
                "m15-depth-offset-sign",
            ),
            (
                "nx/(r-l) 0 0 0; 0 ny/(t-b) 0 0; 0 0 2/(n-f) 0; -1/2-l*nx/(r-l) -1/2-b*ny/(t-b) -(n+f)/(n-f) 1",
                "transposed",
            ),
        ],
        unknown: (
            "nx/(r-l) 0 0 -1/2-r*nx/(r-l); 0 ny/(t-b) 0 -1/2-b*ny/(t-b); 0 0 2/(n-f) -(n+f)/(n-f); 0 0 0 1",
            "1 of 16 entries is not right",
        ),
    },
    Case {
        number: 3,
        right: &["A=n+f; B=-n*f", "n + f, -f n", "B = -(nf), A = f+n"],
        mistaken: &[
            ("A=n+f; B=n*f", "sign-of-b"),
            ("-n-f, -n*f", "sign-of-a"),
            ("A=-(n+f); B=n*f", "both-signs"),
            ("A=-n*f; B=n+f", "a-and-b-exchanged"),
            ("A=n-f; B=-n*f", "difference-for-sum"),
            ("A=1; B=0", "not-divided"),
            ("A=2/(n-f); B=-(n+f)/(n-f)", "m-orth"),
            ("A=(f+n)/(n-f); B=2*f*n/(f-n)", "m-per"),
        ],
        unknown: ("A=n+f; B=2f", "1 of 2 entries is not right for n = -1, f = -5: B is -10"),
    },
    Case {
        number: 4,
        right: &["n*f*(z1-z2)/(z1*z2)", "n f (z_1 - z_2)/(z_1 z_2)", "z1'-z2' = fn/z2 - fn/z1"],
        mistaken: &[
            ("n*f*(z2-z1)/(z1*z2)", "sign"),
            ("n*f*(z1-z2)", "divisor-forgotten"),
            ("1/z2 - 1/z1", "factor-forgotten"),
            ("z1 - z2", "linear"),
        ],
        unknown: ("n*f*(z1-z2)/(z1+z2)", "1 of 1 entry is not right"),
    },
    Case {
        number: 5,
        right: &["h*a, h*b, h*c, h", "(ha, hb, hc, h)", "h*a h*b h*c h"],
        mistaken: &[
            ("a, b, c, 1", "divided-too-early"),
            ("h*a, h*b, h*c, 1", "w-lost"),
            ("a, b, c, h", "only-w-multiplied"),
            ("a/h, b/h, c/h, 1", "divided-by-h"),
        ],
        unknown: (
            "h*a, h*b, h*c, h^2",
            "1 of 4 entries is not right for a = 3, b = 5, c = -2, h = 4: w is 16",
        ),
    },
    Case {
        number: 6,
        right: &[
            "f 0 0 0; 0 f 0 0; 0 0 0 n*f; 0 0 -1 n+f",
            "1/n 0 0 0; 0 1/n 0 0; 0 0 0 1; 0 0 -1/(n*f) 1/n+1/f",
            "-f 0 0 0; 0 -f 0 0; 0 0 0 -n*f; 0 0 1 -n-f",
        ],
        mistaken: &[
            ("n 0 0 0; 0 n 0 0; 0 0 n+f -f*n; 0 0 1 0", "not-inverted"),
            ("n 0 0 0; 0 n 0 0; 0 0 0 n*f; 0 0 -1 n+f", "near-and-far-exchanged"),
            ("f 0 0 0; 0 f 0 0; 0 0 0 n*f; 0 0 1 n+f", "last-row-sign"),
            ("1/n 0 0 0; 0 1/n 0 0; 0 0 1/(n+f) -1/(f*n); 0 0 1 0", "entries-inverted"),
            ("f 0 0 0; 0 f 0 0; 0 0 0 1; 0 0 -1 n+f", "factor-lost"),
            ("f 0 0 0; 0 f 0 0; 0 0 0 -1; 0 0 n*f n+f", "transposed"),
        ],
        unknown: ("f 0 0 0; 0 f 0 0; 0 0 0 n*f; 0 0 -1 n-f", "row 4, column 4 is 4"),
    },
    Case {
        number: 7,
        right: &["n, n, n, n", "(n n n n)", "x=n, y=n, z=n, w=n"],
        mistaken: &[
            ("1, 1, 1, 1", "divided-too-early"),
            ("1, 1, 1", "divided-too-early"),
            ("n, n, n, 1", "w-lost"),
            ("-n, -n, -n, -n", "sign-of-w"),
            ("n, n, -n, n", "m8-depth-reversed"),
            ("n*r, n*t, n^2, n", "p-only"),
            ("r, t, n, 1", "not-mapped"),
        ],
        unknown: ("n, n, n, -n", "w is 1, only its sign is wrong"),
    },
    Case {
        number: 8,
        right: &[
            "1 0 0 0; 0 1 0 0; 0 0 3 -2; 0 0 1 0",
            "1 0 0 0 0 1 0 0 0 0 3 -2 0 0 1 0",
            "1/2 0 0 0; 0 .5 0 0; 0 0 1.5 -1; 0 0 ½ 0",
        ],
        mistaken: &[
            ("1 0 0 0; 0 1 0 0; 0 0 3 2; 0 0 1 0", "sign-of-the-product"),
            ("2 0 0 0; 0 2 0 0; 0 0 3 -2; 0 0 1 0", "near-and-far-exchanged"),
            ("1 0 0 0; 0 1 0 0; 0 0 -1 -2; 0 0 1 0", "difference-for-sum"),
            ("1 0 0 0; 0 1 0 0; 0 0 3 -2; 0 0 0 1", "w-lost"),
            ("1 0 0 0; 0 1 0 0; 0 0 3 -2; 0 0 1 1", "m14-bottom-row"),
            ("1 0 0 0; 0 1 0 0; 0 0 3 -2; 0 0 -1 0", "last-row-negated"),
            ("-1 0 0 0; 0 -1 0 0; 0 0 -3 2; 0 0 -1 0", "negated"),
            ("1 0 0 0; 0 1 0 0; 0 0 3 1; 0 0 -2 0", "transposed"),
        ],
        unknown: ("1 0 0 0; 0 1 0 0; 0 0 3 -3; 0 0 1 0", "row 3, column 4 is -3"),
    },
    Case {
        number: 9,
        right: &["x, y, 3*z-2, z; x/z, y/z, 3-2/z", "x y 3z-2 z; x/z y/z (3z - 2)/z"],
        mistaken: &[
            ("x, y, 3z-2, z; x, y, 3z-2", "not-divided"),
            ("x, y, 3z-2, z; x/z, y/z, 3z-2", "z-not-divided"),
            ("x, y, 3z-2, z; 1/z, 1/z, 3-2/z", "m1-coordinate-lost"),
            ("x, y, 3z-2, 1; x/z, y/z, 3-2/z", "w-lost"),
            ("x, y, 3z+2, z; x/z, y/z, 3+2/z", "sign-of-the-product"),
        ],
        unknown: ("x, y, 3z-2, z; x/z, y/z, 3-z/2", "z of part 2 is 1"),
    },
    Case {
        number: 10,
        right: &["0 0 1 0; 1 0 0 0; 0 1 0 -1; 0 0 0 1", "[0,0,1,0],[1,0,0,0],[0,1,0,-1],[0,0,0,1]"],
        mistaken: &[
            ("0 0 -1 0; 1 0 0 0; 0 -1 0 1; 0 0 0 1", "gaze-for-w"),
            ("0 0 -1 0; 1 0 0 0; 0 1 0 -1; 0 0 0 1", "u-turned"),
            ("1 0 0 0; 0 0 1 0; 0 1 0 -1; 0 0 0 1", "u-and-v-exchanged"),
            ("0 0 1 0; 1/sqrt(2) 1/sqrt(2) 0 -sqrt(2)/2; 0 1 0 -1; 0 0 0 1", "up-for-v"),
            ("0 0 1 0; 1 0 0 0; 0 1 0 0; 0 0 0 1", "eye-forgotten"),
            ("0 0 1 0; 1 0 0 0; 0 1 0 1; 0 0 0 1", "eye-added"),
            ("0 0 1 0; 1 0 0 -1; 0 1 0 0; 0 0 0 1", "order-exchanged"),
            ("0 1 0 0; 0 0 1 1; 1 0 0 0; 0 0 0 1", "inverse"),
            ("0 0 0 0; 1 0 0 0; 0 1 0 -1; 0 0 0 1", "m11-third-row-flat"),
            ("0 1 0 0; 0 0 1 0; 1 0 0 0; 0 0 -1 1", "transposed"),
        ],
        unknown: ("0 0 1 0; 1 0 0 0; 0 1 0 -2; 0 0 0 1", "row 3, column 4 is -2"),
    },
    Case {
        number: 11,
        right: &[
            "wR*t/(wr+t*(wR-wr))",
            "f(t) = w_R t/((1-t) w_r + t w_R)",
            "1 - wr(1-t)/(wr + t(wR-wr))",
        ],
        mistaken: &[
            ("t", "linear"),
            ("wr*t/(wR+t*(wr-wR))", "inverse"),
            ("wr*t/(wr+t*(wR-wr))", "other-weight"),
            ("wr+t*(wR-wr)", "weight-alone"),
            ("t/(wr+t*(wR-wr))", "weight-forgotten"),
            ("wr*(1-t)/(wr+t*(wR-wr))", "from-the-other-end"),
        ],
        unknown: ("wR*t/(wr-t*(wR-wr))", "1 of 1 entry is not right"),
    },
];

const OWN: [Case; 13] = [
    Case {
        number: 12,
        right: &["1, -3, -2", "(1, -6/2, -2)"],
        mistaken: &[
            ("-2, 6, 4", "w-lost"),
            ("4, -12, -8", "multiplied"),
            ("-1, 3, 2", "sign-of-w-lost"),
            ("1, -3, 4", "z-not-divided"),
        ],
        unknown: ("1, -3, 2", "z is 2, only its sign is wrong"),
    },
    Case {
        number: 13,
        right: &["4, 2, -3", "z = -3; x = 4; y = 2"],
        mistaken: &[
            ("4, 2, 3", "sign-of-z"),
            ("-4, 2, -3", "left-handed"),
            ("4, 2, -1", "eye-forgotten"),
            ("4, 2, 1", "eye-added"),
            ("-3, 2, -4", "not-rotated"),
        ],
        unknown: ("4, 0, -3", "1 of 3 entries is not right: y is 0"),
    },
    Case {
        number: 14,
        right: &["1+sqrt(3), 2", "1 + 2cos(30°), 1 + 2sin(30°)", "1+√3 2", "2.7320508075688772, 2"],
        mistaken: &[
            ("1+2*sqrt(3), 3", "cavalier"),
            ("1+4*sqrt(3), 5", "tangent-for-factor"),
            ("1-sqrt(3), 0", "sign-of-z"),
            ("2, 1+sqrt(3)", "sine-and-cosine-exchanged"),
            ("1+2cos(30), 1+2sin(30)", "degrees-as-radians"),
            ("1, 1", "depth-dropped"),
            ("√3, 1", "foot-forgotten"),
        ],
        unknown: ("1+√2, 2", "x is 2.414214"),
    },
    Case {
        number: 15,
        right: &["1/2, -1", "(0.5, -1)"],
        mistaken: &[
            ("-1/2, 1", "sign-of-z"),
            ("1/4, -1/2", "distance-forgotten"),
            ("-1/4, 1/2", "sign-and-distance"),
            ("1, -2", "direction-itself"),
            ("1/8, -1/4", "distance-divided"),
        ],
        unknown: ("1/2, 1", "y is 1, only its sign is wrong"),
    },
    Case {
        number: 16,
        right: &["80/21", "D = 2*40*2/(40+2)", "3.8095238095238"],
        mistaken: &[
            ("-80/21", "sign-of-z"),
            ("3.8", "printed-rounding"),
            ("-3.8", "printed-rounding"),
            ("21", "middle"),
            ("40/21", "factor-two-lost"),
            ("sqrt(80)", "geometric-mean"),
        ],
        unknown: ("19", "D is 19"),
    },
    Case {
        number: 17,
        right: &["1/4", "0.25"],
        mistaken: &[
            ("3/4", "not-reversed"),
            ("5/8", "linear"),
            ("3/8", "linear-and-not-reversed"),
            ("2/5", "infinite-far-plane"),
            ("1/2", "opengl-range"),
        ],
        unknown: ("1/3", "d is 0.333333"),
    },
    Case {
        number: 18,
        right: &["1/5, 2/3", "t1 = 2/3; t0 = 0.2"],
        mistaken: &[
            ("1/4, 1/2", "m28-cube"),
            ("3/7, 6/7", "divided-too-early"),
            ("2/3, 1/5", "ends-exchanged"),
            ("1/3, 4/5", "from-the-other-end"),
        ],
        unknown: ("1/5, 1", "t1 is 1"),
    },
    Case {
        number: 19,
        right: &["18", "2+16"],
        mistaken: &[
            ("22", "m28-cube"),
            ("33", "sides-exchanged"),
            ("45", "inside-bits"),
            ("2", "one-plane-only"),
            ("16", "one-plane-only"),
            ("010010", "binary-digits"),
            ("36", "bits-from-one"),
        ],
        unknown: ("20", "outcode is 20"),
    },
    Case {
        number: 20,
        right: &["125, 35", "(1/4+1)*100, (1-3/10)*50"],
        mistaken: &[
            ("125, 65", "rows-from-the-bottom"),
            ("124.5, 34.5", "centers-at-whole-numbers"),
            ("124.5, 64.5", "chapter-viewport"),
            ("25, 15", "range-forgotten"),
            ("50, 30", "zero-to-one"),
            ("124.375, 34.65", "size-less-one"),
        ],
        unknown: ("35, 125", "2 of 2 entries are not right"),
    },
    Case {
        number: 21,
        right: &["100 0 -190; 0 50 -30; 0 0 1", "100,0,10-2*100;0,50,20-50;0,0,1"],
        mistaken: &[
            ("100 0 -190; 0 50 70; 0 0 1", "m18-sign"),
            ("100 0 -200; 0 50 -50; 0 0 1", "viewport-corner-forgotten"),
            ("100 0 10; 0 50 20; 0 0 1", "window-corner-forgotten"),
            ("100 0 8; 0 50 19; 0 0 1", "window-corner-not-scaled"),
            ("1/100 0 19/10; 0 1/50 3/5; 0 0 1", "inverse"),
            ("100 0 0; 0 50 0; -190 -30 1", "transposed"),
        ],
        unknown: ("100 0 -190; 0 50 -30; 0 1 1", "row 3, column 2 is 1"),
    },
    Case {
        number: 22,
        right: &["10", "4*5/2"],
        mistaken: &[
            ("15", "closed"),
            ("3", "open"),
            ("6", "bottom-right"),
            ("8", "area"),
            ("9", "corner-lost"),
        ],
        unknown: ("12", "pixels is 12"),
    },
    Case {
        number: 23,
        right: &["34/13", "(3/4*2 + 1/4*10/4)/(3/4 + 1/4/4)"],
        mistaken: &[
            ("4", "linear"),
            ("46/7", "weights-by-w"),
            ("17/8", "not-divided"),
            ("38/7", "from-the-other-end"),
        ],
        unknown: ("3", "a is 3"),
    },
    Case {
        number: 24,
        right: &["1/5", "t = 0.2"],
        mistaken: &[("1/2", "linear"), ("4/5", "forwards"), ("1/4", "ratio-of-weights")],
        unknown: ("1/3", "t is 0.333333"),
    },
];

fn check(number: u32, answer: &str) -> Verdict {
    let exercise = find_exercise(number).expect("an exercise");
    exercise.check(answer).expect(answer)
}

fn cases() -> impl Iterator<Item = &'static Case> {
    CHAPTER.iter().chain(&OWN)
}

/// C38 to C47 and C104: the answers of the chapter's exercises and of the project's own.
#[test]
fn exercises_have_right_answers_in_several_notations() {
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
fn every_mistake_is_named_and_no_two_are_told_alike() {
    for Case { number, mistaken, .. } in cases() {
        let mut told = BTreeSet::new();
        for (answer, id) in *mistaken {
            let verdict = check(*number, answer);
            let said = verdict.sentence();
            let Verdict::Mistaken(mistake) = verdict else {
                panic!("{number}, {answer}: {}", said.en);
            };
            assert_eq!(mistake.id, *id, "{number}, {answer}");
            assert!(said.en.starts_with("wrong: ") && said.zh.starts_with("错误："));
            assert!(told.insert((said.en, said.zh)), "{number}, {answer}");
        }
        let all = &find_exercise(*number).expect("an exercise").mistakes;
        assert_eq!(told.len(), all.len(), "{number}: some mistakes are not tried");
    }
}

#[test]
fn wrong_answers_without_a_name_are_told_entry_by_entry() {
    for Case { number, unknown: (answer, part), .. } in cases() {
        let verdict = check(*number, answer);
        assert!(matches!(verdict, Verdict::Different { .. }), "{number}: {verdict:?}");
        let said = verdict.sentence();
        assert!(said.en.starts_with("wrong: ") && said.en.contains(part), "{number}: {}", said.en);
        assert!(said.zh.starts_with("错误："), "{number}: {}", said.zh);
    }
}

#[test]
fn rounded_answers_are_told_and_others_are_refused() {
    for (number, answer) in [(16, "3.81"), (14, "2.732, 2"), (23, "2.615"), (24, "0.2001")] {
        let verdict = check(number, answer);
        assert!(matches!(verdict, Verdict::Rounded), "{number}, {answer}: {verdict:?}");
    }
    for (number, answer, part) in [
        (8, "1 0 0 0; 0 1 0 0; 0 0 3 -2", "4 + 4 + 4 entries instead of 4 + 4 + 4 + 4"),
        (12, "1, -3", "2 entries instead of 3: give `x, y, z`"),
        (3, "A=n+f", "`B`"),
        (3, "A=n+g; B=1", "the letters are n, f"),
        (12, "x, y, z", "numbers only"),
        (16, "1/0", "no finite number"),
        (16, "", "empty"),
    ] {
        let error = find_exercise(number).expect("an exercise").check(answer);
        let error = error.expect_err(answer);
        assert!(error.to_string().contains(part), "{number}, {answer}: {error}");
        assert!(!error.message.zh.is_empty());
    }
    assert!(find_exercise(0).is_none() && find_exercise(25).is_none());
}

/// Whether the text has a Han character.
fn is_chinese(text: &str) -> bool {
    text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c))
}

#[test]
fn every_text_is_in_both_languages() {
    for exercise in exercises() {
        let number = exercise.number;
        let form = exercise.form();
        assert!(!exercise.hints.is_empty() && exercise.mistakes.len() >= 3, "{number}");
        let mut texts = vec![(exercise.question.en, exercise.question.zh), (&*form.en, &*form.zh)];
        texts.extend(exercise.hints.iter().map(|hint| (hint.en, hint.zh)));
        texts.extend(exercise.mistakes.iter().map(|each| (each.sentence.en, each.sentence.zh)));
        for (en, zh) in texts {
            assert!(!is_chinese(en) && en.len() > 4, "{number}: {en}");
            // What is a formula alone is the same in both.
            assert!(is_chinese(zh) || en == zh || !zh.is_ascii(), "{number}: {zh}");
            assert!(!zh.contains(['.', ';', '?']) || zh.contains('`') || is_chinese(zh), "{zh}");
            for half in [", ", "; ", ": "] {
                let between_han = zh.match_indices(half).any(|(at, _)| {
                    zh[..at].chars().next_back().is_some_and(|c| is_chinese(&c.to_string()))
                });
                assert!(!between_han, "{number}: half-width `{half}` behind Han in {zh}");
            }
        }
    }
}
