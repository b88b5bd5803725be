//! Rule for terms: the Chinese text of the book, the explorer and the program uses one word per
//! concept.

use super::Violation;

/// Variants, each with the term to use instead. The book's glossary is exempt, because it lists
/// synonyms for readers who know a different term.
const VARIANTS: [(&str, &str); 18] = [
    ("外码", "区域码"),
    ("归一化", "规范化"),
    ("相机坐标", "观察坐标"),
    ("相机空间", "观察坐标系"),
    ("缩短系数", "轴向伸缩系数"),
    ("变形系数", "轴向伸缩系数"),
    ("等轴测", "正等测"),
    ("二轴测", "正二测 or 斜二测"),
    ("三轴测", "正三测"),
    ("多视图", "多面正投影"),
    ("截头", "视锥体"),
    ("偏轴", "离轴"),
    ("偏心", "离轴"),
    ("地平线", "视平线"),
    ("按射线", "按光线"),
    ("课题", "课程 or 题目"),
    ("视图流水线", "观察流水线"),
    ("管线", "流水线"),
];

/// Finds lines with a variant of a term.
pub fn chinese_variants(files: &[(String, String)]) -> Vec<Violation> {
    let is_checked =
        |path: &str| path != "book/src/words.md" && !path.starts_with("xtask/src/tidy");
    let mut violations = Vec::new();
    for (path, text) in files.iter().filter(|(path, _)| is_checked(path)) {
        for (i, line) in text.lines().enumerate() {
            let found = VARIANTS.iter().filter(|(variant, _)| line.contains(variant));
            violations.extend(found.map(|(variant, term)| {
                let location = format!("{path}:{}", i + 1);
                Violation::new(location, format!("`{variant}`: use the term {term}"))
            }));
        }
    }
    violations
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variants_are_found_outside_the_glossary() {
        let line = "msgstr \"裁剪\"\nmsgstr \"地平线\"".to_owned();
        let found = chinese_variants(&[("book/po/zh/clip.po".to_owned(), line.clone())]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].location, "book/po/zh/clip.po:2");
        assert!(chinese_variants(&[("book/src/words.md".to_owned(), line)]).is_empty());
    }
}
