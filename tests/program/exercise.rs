//! `alberti exercise`: questions in two languages, verdicts with their exit codes, JSON.

use crate::sandbox::{RunResult, Sandbox};
use serde_json::Value;
use std::path::Path;

/// Runs the program in English, regardless of the environment.
fn run(sandbox: &Sandbox, arguments: &[&str]) -> RunResult {
    let words: Vec<&str> = ["exercise"].iter().chain(arguments).copied().collect();
    sandbox.run_with_variable(("LC_ALL", Path::new("C")), &words)
}

#[test]
fn exercises_are_listed_and_printed_with_hints() {
    let sandbox = Sandbox::new("exercise_questions");
    let list = run(&sandbox, &[]);
    assert_eq!((list.code, list.stderr.as_str()), (0, ""));
    assert_eq!(list.stdout.lines().count(), 24, "{}", list.stdout);
    assert!(list.stdout.contains("\n 3  The third row of P\n"), "{}", list.stdout);
    let question = run(&sandbox, &["3"]);
    assert_eq!(question.code, 0);
    for part in [
        "Exercise 3: The third row of P\n\n",
        "Find A and B.",
        "Answer: `A, B`, in terms of n, f.",
        "alberti exercise 3 --answer",
    ] {
        assert!(question.stdout.contains(part), "{part}: {}", question.stdout);
    }
    assert!(question.stdout.lines().all(|line| line.chars().count() <= 100));
    let hints = run(&sandbox, &["3", "--hint"]).stdout;
    assert!(hints.starts_with("1. ") && hints.contains("\n2. "), "{hints}");
    for wrong in ["0", "25"] {
        let run = run(&sandbox, &[wrong]);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""));
        assert!(run.stderr.contains("there is no exercise") && run.stderr.contains("1 to 24"));
    }
    let help = run(&sandbox, &["--help"]).stdout;
    assert!(help.contains("--answer 'A=1; B=0'"), "{help}");
    for answer in ["80/21", "1+sqrt(3)", "-n*f", "3 -2", "3 2;"] {
        assert!(!help.contains(answer), "the help gives away {answer}: {help}");
    }
    for wrong in [&["--answer", "1"][..], &["3", "--hint", "--answer", "1"], &["three"]] {
        assert_eq!(run(&sandbox, wrong).code, 2, "{wrong:?}");
    }
}

#[test]
fn verdicts_have_an_exit_code_and_name_the_mistake() {
    let sandbox = Sandbox::new("exercise_answers");
    for (number, answer, code, said) in [
        ("3", "A=n+f; B=-n*f", 0, "correct\n"),
        ("3", "n+f, n*f", 1, "incorrect: the sign of B"),
        ("4", "-n*f*(z2-z1)/(z1*z2)", 0, "correct\n"),
        ("16", "80/21", 0, "correct\n"),
        ("16", "-80/21", 1, "incorrect: this has the sign of a z-coordinate"),
        ("16", "3.8", 1, "incorrect: this is the lesson's rounded value"),
        ("16", "3.81", 1, "incorrect: this is rounded; "),
        ("8", "1 0 0 0\n0 1 0 0\n0 0 3 -2\n0 0 1 0", 0, "correct\n"),
        (
            "8",
            "1 0 0 0; 0 1 0 0; 0 0 3 -2; 0 0 1 5",
            1,
            "incorrect: your value for row 4, column 4 is 5",
        ),
        ("21", "100 0 -190; 0 50 70; 0 0 1", 1, "incorrect: the window was moved by +1 in y"),
        ("4", "f*n*[z1-z2]/(z1*z2)", 0, "correct\n"),
        ("3", "n+f, -f_n", 1, "incorrect: this has a subscript"),
        ("7", "n*(1,1,1,1)", 0, "correct\n"),
        ("17", "1/3", 1, "incorrect: your value for d is 0.333333\n"),
    ] {
        let run = run(&sandbox, &[number, "--answer", answer]);
        assert_eq!((run.code, run.stderr.as_str()), (code, ""), "{number}, {answer}");
        assert!(run.stdout.contains(said), "{number}, {answer}: {}", run.stdout);
    }
    for (number, answer, part) in [
        ("3", "A=q; B=1", "`q` is not a symbol of this exercise; the symbols are n, f"),
        ("12", "1 2", "2 entries instead of 3"),
        ("16", "", "the answer is empty"),
        ("16", "((((", "incomplete"),
    ] {
        let run = run(&sandbox, &[number, "--answer", answer]);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{number}, {answer}");
        let said = format!("error: {}", run.stderr.trim_start_matches("error: "));
        assert!(said == run.stderr && said.contains(part), "{number}, {answer}: {}", run.stderr);
    }
}

#[test]
fn text_is_chinese_if_the_flag_or_the_environment_selects_it() {
    let sandbox = Sandbox::new("exercise_chinese");
    let by_flag = run(&sandbox, &["3", "--language", "zh"]).stdout;
    assert!(by_flag.starts_with("习题 3：P 的第三行\n"), "{by_flag}");
    let in_locale = |name: &str, value: &str, more: &[&str]| {
        let words: Vec<&str> = ["exercise", "3"].iter().chain(more).copied().collect();
        sandbox.run_with_variable((name, Path::new(value)), &words)
    };
    assert_eq!(in_locale("LC_ALL", "zh_CN.UTF-8", &[]).stdout, by_flag);
    let english = in_locale("LC_ALL", "zh_CN.UTF-8", &["--language", "en"]).stdout;
    assert!(english.starts_with("Exercise 3"), "{english}");
    let wrong = in_locale("LC_ALL", "zh_TW", &["--answer", "n+f, n*f"]);
    assert!(wrong.code == 1 && wrong.stdout.starts_with("不对：B 的符号不对"), "{}", wrong.stdout);
    let right = in_locale("LC_ALL", "zh", &["--answer", "A＝n＋f；B＝−n·f"]);
    assert_eq!((right.code, right.stdout.as_str()), (0, "正确\n"));
    let error = in_locale("LC_ALL", "zh", &["--answer", "q, 1"]);
    assert!(error.code == 1 && error.stderr.contains("不是本题的字母"), "{}", error.stderr);
    let missing = run(&sandbox, &["99", "--language", "zh"]);
    assert_eq!((missing.code, missing.stdout.as_str()), (1, ""));
    assert!(missing.stderr.starts_with("error: 没有习题 99\n"), "{}", missing.stderr);
    assert!(missing.stderr.contains("习题编号为 1 到 24"), "{}", missing.stderr);
}

#[test]
fn the_json_document_has_both_languages_and_the_verdict() {
    let sandbox = Sandbox::new("exercise_json");
    let json = |arguments: &[&str]| -> Value {
        serde_json::from_str(&run(&sandbox, arguments).stdout).expect("JSON")
    };
    let list = json(&["--json"]);
    assert_eq!(list["schema"]["name"], "alberti-exercise");
    assert_eq!(list["exercises"].as_array().map(Vec::len), Some(24));
    assert_eq!(list["verdict"], Value::Null);
    let wrong = json(&["10", "--json", "--answer", "0 1 0 0; 0 0 1 1; 1 0 0 0; 0 0 0 1"]);
    assert_eq!(wrong["exercises"][0]["title"]["zh"], "俯视的相机");
    assert_eq!(wrong["verdict"]["kind"], "mistake");
    assert_eq!(wrong["verdict"]["mistake"], "inverse");
    let different = json(&["3", "--json", "--answer", "n+f, 2f"]);
    let verdict = &different["verdict"];
    assert_eq!((&verdict["kind"], &verdict["mistake"]), (&"different".into(), &Value::Null));
    let difference = &verdict["differences"][0];
    assert_eq!((&difference["row"], &difference["column"]), (&1.into(), &2.into()));
    assert_eq!(difference["name"]["en"], "B");
    assert_eq!(difference["value"], 2.0 * verdict["letters"]["f"].as_f64().expect("f"));
}
