//! A drawing sheet in a scene file: paper, arrangement of the views, scale and title block.

use super::DimensionsFile;
use super::assembly::{DensityFile, ExplodedFile};
use super::sheet_view::SheetViewFile;
use crate::number::Positive;
use crate::schema::{named_enum, scene_struct};
use drawing::{FaceFill, HiddenLines};
use model::LengthUnit;
use projection::SheetAngle;
use sheet::{DecimalMark, DimensionUnit, SheetFrame, TitleBlockLanguage};

scene_struct! {
    /// A drawing sheet with views of the models.
    pub struct SheetFile as "Sheet" {
        /// The paper size. Default: A3.
        pub paper: PaperSize = PaperSize::A3,
        /// The orientation of the paper. Default: the one in which the views are larger; if they
        /// are equal, portrait for A4, A5 and Letter, landscape for all others.
        pub orientation: Option<PageOrientation> = None,
        /// The arrangement of the views. Default: first angle.
        pub projection_angle: SheetAngle = SheetAngle::First,
        /// The scale, paper to object, as in (1, 50). Default: the largest of the standard series
        /// that fits.
        pub scale: Option<(u32, u32)> = None,
        /// The unit of the models. Default: that of their files: meters in glTF, millimeters in
        /// STL. With inches or feet the dimensions are in inches, else in millimeters.
        pub unit: Option<LengthUnit> = None,
        /// The view beside the front view. Default: from the left in first angle, from the right in
        /// third; the other one if only that looks onto a section.
        pub side_view: Option<SideView> = None,
        /// The fourth view. Default: isometric.
        pub axonometric_view: AxonometricView = AxonometricView::Isometric,
        /// How hidden lines are drawn in views that are not cut, along the axes. Default: as in the
        /// scene's line style, else dashed.
        pub hidden: Option<HiddenLines> = None,
        /// The fill of the faces under the lines, on all pages. Default: as in the scene's line
        /// style, else none.
        pub face_fill: Option<FaceFill> = None,
        /// The width of wide lines in millimeters, a line group of ISO 128. Default: that of the
        /// scene's line style if it is in millimeters, else to suit the paper.
        pub width: Option<Positive> = None,
        /// The dimensions: `true` for the overall ones, `false` for none, or a list such as
        /// `[Overall, Length(from: Node(name: "lid"), to: Point((0, 0, 0)))]`. Default: true.
        pub dimensions: DimensionsFile = DimensionsFile::overall(),
        /// Whether circles and the axes of round parts have center lines: chain lines of ISO 128.
        /// A circle is an edge of at least eight equal parts, of which half a turn is there.
        /// Default: false.
        pub center_lines: bool = false,
        /// Whether models that are symmetric have a line of symmetry in the views that look along the
        /// plane, where that is upright or level: chain lines of ISO 128. Default: false.
        pub symmetry_lines: bool = false,
        /// The title. Default: the names of the models.
        pub title: String = String::new(),
        /// The author. Default: the field is left out.
        pub author: String = String::new(),
        /// The date, as it is to be printed. Default: the field is left out.
        pub date: String = String::new(),
        /// The drawing number. Default: the field is left out.
        pub number: String = String::new(),
        /// Whether a list counts the equal parts of the models: their nodes with meshes. It stands
        /// on the page of the assembly, else on pages of its own. Default: false.
        pub parts_list: bool = false,
        /// Whether a page shows the assembly, in the axonometric view, with the number of each item
        /// of the list in a balloon. Default: false.
        pub balloons: bool = false,
        /// How the parts are moved apart on the page of the assembly, which need not have balloons.
        /// Default: they stay in their places.
        pub exploded: Option<ExplodedFile> = None,
        /// Whether each item of the list has a page of its own, with its principal views. Default:
        /// false.
        pub part_sheets: bool = false,
        /// The densities from which the masses of the list follow. Default: none, and no masses.
        pub densities: Vec<DensityFile> = Vec::new(),
        /// Views beyond the usual ones, or in their place, and ways to show them. A list with a
        /// `View` names all views; without any, front, top, side and axonometric view are there as
        /// well. Default: none.
        pub views: Vec<SheetViewFile> = Vec::new(),
        /// The second line of the title. With it, or an owner, a document type, a name of who
        /// approved the drawing or a revision, the title block has all fields of ISO 7200.
        /// Default: none.
        pub supplementary_title: String = String::new(),
        /// The legal owner, such as a company. Default: none.
        pub owner: String = String::new(),
        /// The type of the document, such as "Part drawing". Default: none.
        pub document_type: String = String::new(),
        /// Who approved the drawing. Default: none.
        pub approved_by: String = String::new(),
        /// The revision index, such as "B". Default: none.
        pub revision: String = String::new(),
        /// The number of the sheet and that of all sheets, as in (2, 5). Default: no number.
        pub sheet_number: Option<(u32, u32)> = None,
        /// The language of the names of the title block's fields. Default: English.
        pub language: TitleBlockLanguage = TitleBlockLanguage::English,
        /// The path of a title block of one's own, an SVG file with fields such as {title} in its
        /// texts, in the folder of the scene or below. Default: the program's title block.
        pub title_block: Option<String> = None,
        /// The border around the drawing area. Default: a plain line.
        pub frame: SheetFrame = SheetFrame::Plain,
        /// The unit in which lengths are written. Default: inches if the unit of the models is
        /// inches or feet, else millimeters.
        pub dimension_unit: Option<DimensionUnit> = None,
        /// The most decimals of lengths, from 0 to 6; zeros at the end are left out. Default: 2 in
        /// millimeters and none from one meter on, 3 in inches, sixteenths in feet and inches.
        pub decimals: Option<u32> = None,
        /// The sign before decimals. Default: a point.
        pub decimal_mark: DecimalMark = DecimalMark::Point,
    }
}

named_enum! {
    /// A paper size.
    pub enum PaperSize as "Paper" {
        A0 = "841 × 1189 mm.",
        A1 = "594 × 841 mm.",
        A2 = "420 × 594 mm.",
        A3 = "297 × 420 mm.",
        A4 = "210 × 297 mm.",
        A5 = "148 × 210 mm.",
        Letter = "8½ × 11 inches.",
        Tabloid = "11 × 17 inches.",
        Auto = "The smallest of A4 to A0 that holds the views at 1:1 or larger, or at the scale \
                that is given; if A0 does not, the smallest of which the next larger one gives no \
                larger scale.",
    }
}

named_enum! {
    /// The orientation of paper.
    pub enum PageOrientation as "Orientation" {
        Portrait = "Upright.",
        Landscape = "On its long side.",
    }
}

named_enum! {
    /// The view beside the front view.
    pub enum SideView as "SideView" {
        Left = "From the left.",
        Right = "From the right.",
    }
}

named_enum! {
    /// The fourth view of a sheet.
    pub enum AxonometricView as "AxonometricView" {
        None = "No fourth view.",
        Isometric = "All axes foreshortened alike.",
        Dimetric = "x and y foreshortened alike: 7° and 42°.",
        Trimetric = "Each axis foreshortened by a factor of its own.",
        ThreeQuarter = "From the front, a little from the right and from above.",
    }
}
