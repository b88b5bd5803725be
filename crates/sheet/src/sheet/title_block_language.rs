//! Languages of the title block, and the field names in each.

/// The language of the field names. The values are not translated.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum TitleBlockLanguage {
    /// English.
    #[default]
    English,
    /// German, with the terms of DIN EN ISO 7200.
    German,
    /// Simplified Chinese, with the terms of GB/T 10609.1.
    Chinese,
}

/// A field of the title block.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum FieldName {
    Author,
    Date,
    Number,
    Title,
    Scale,
    Paper,
    Unit,
    Projection,
    Program,
    Owner,
    DocumentType,
    Creator,
    ApprovedBy,
    DocumentNumber,
    DateOfIssue,
    Revision,
    Language,
    Sheet,
}

impl TitleBlockLanguage {
    /// Returns the language code (ISO 639-1).
    #[must_use]
    pub const fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::German => "de",
            Self::Chinese => "zh",
        }
    }

    /// Returns the name of a field.
    pub(super) const fn field_name(self, field: FieldName) -> &'static str {
        let [english, german, chinese] = match field {
            FieldName::Author => ["Author", "Ersteller", "设计"],
            FieldName::Date => ["Date", "Datum", "日期"],
            FieldName::Number => ["Number", "Nummer", "图号"],
            FieldName::Title => ["Title", "Titel", "名称"],
            FieldName::Scale => ["Scale", "Maßstab", "比例"],
            FieldName::Paper => ["Paper", "Format", "图幅"],
            FieldName::Unit => ["Dimensions in", "Maße in", "单位"],
            FieldName::Projection => ["Projection", "Projektion", "投影"],
            FieldName::Program => ["Drawn with", "Gezeichnet mit", "软件"],
            FieldName::Owner => ["Legal owner", "Gesetzlicher Eigentümer", "单位名称"],
            FieldName::DocumentType => ["Document type", "Dokumentenart", "类型"],
            FieldName::Creator => ["Created by", "Erstellt durch", "设计"],
            FieldName::ApprovedBy => ["Approved by", "Genehmigt von", "批准"],
            FieldName::DocumentNumber => ["Document number", "Dokumentennummer", "图号"],
            FieldName::DateOfIssue => ["Date of issue", "Ausgabedatum", "日期"],
            FieldName::Revision => ["Rev.", "Änd.", "版本"],
            FieldName::Language => ["Lang.", "Spr.", "语言"],
            FieldName::Sheet => ["Sheet", "Blatt", "页"],
        };
        match self {
            Self::English => english,
            Self::German => german,
            Self::Chinese => chinese,
        }
    }
}
