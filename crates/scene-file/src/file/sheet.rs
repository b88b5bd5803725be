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
        /// The orientation of the paper. Default: the one that makes the views larger. If both make
        /// them equally large, portrait for A4, A5 and Letter and landscape for all others.
        pub orientation: Option<PageOrientation> = None,
        /// The arrangement of the views. Default: first angle.
        pub projection_angle: SheetAngle = SheetAngle::First,
        /// The scale, paper to object, as in (1, 50). Default: the largest standard scale that
        /// fits.
        pub scale: Option<(u32, u32)> = None,
        /// The unit of the models. Default: the unit in their files, which is meters in glTF and
        /// millimeters in STL. With inches or feet, dimensions are in inches, otherwise in
        /// millimeters.
        pub unit: Option<LengthUnit> = None,
        /// The view beside the front view. Default: from the left in first angle, from the right in
        /// third angle; the opposite side if only that view faces a section.
        pub side_view: Option<SideView> = None,
        /// The fourth view. Default: isometric.
        pub axonometric_view: AxonometricView = AxonometricView::Isometric,
        /// The treatment of hidden lines in uncut views along the axes. Default: as in the scene's
        /// line style, otherwise dashed.
        pub hidden: Option<HiddenLines> = None,
        /// The fill of the faces under the lines, on all pages. Default: as in the scene's line
        /// style, otherwise none.
        pub face_fill: Option<FaceFill> = None,
        /// The width of wide lines in millimeters, an ISO 128 line group. Default: from the scene's
        /// line style if that is in millimeters, otherwise chosen to suit the paper.
        pub width: Option<Positive> = None,
        /// The dimensions: `true` for the overall dimensions, `false` for none, or a list such as
        /// `[Overall, Length(from: Node(name: "lid"), to: Point((0, 0, 0)))]`. Default: true.
        pub dimensions: DimensionsFile = DimensionsFile::overall(),
        /// Whether circles and the axes of round parts have center lines: ISO 128 chain lines. A
        /// circle is an edge of at least eight equal parts that covers at least half a turn.
        /// Default: false.
        pub center_lines: bool = false,
        /// Whether symmetric models have a line of symmetry, an ISO 128 chain line, in views along
        /// the plane of symmetry that show it vertical or horizontal. Default: false.
        pub symmetry_lines: bool = false,
        /// The title. Default: the models' names.
        pub title: String = String::new(),
        /// The author. Default: the field is omitted.
        pub author: String = String::new(),
        /// The date, printed as given. Default: the field is omitted.
        pub date: String = String::new(),
        /// The drawing number. Default: the field is omitted.
        pub number: String = String::new(),
        /// Whether the sheet has a parts list, which counts identical parts of the models: their
        /// nodes with meshes. The list goes on the assembly page if there is one, otherwise on
        /// separate pages. Default: false.
        pub parts_list: bool = false,
        /// Whether a page shows the assembly in the axonometric view, with each item's list number
        /// in a balloon. Default: false.
        pub balloons: bool = false,
        /// The exploded view on the assembly page, with or without balloons. Default: the parts
        /// stay in place.
        pub exploded: Option<ExplodedFile> = None,
        /// Whether each item in the parts list has a separate page with its principal views.
        /// Default: false.
        pub part_sheets: bool = false,
        /// The densities from which the masses in the parts list are computed. Default: none, so
        /// the list has no masses.
        pub densities: Vec<DensityFile> = Vec::new(),
        /// Views in addition to or instead of the standard views, and ways to show views. If the
        /// list contains a `View`, it must name all views; otherwise the sheet also has the front,
        /// top, side and axonometric views. Default: none.
        pub views: Vec<SheetViewFile> = Vec::new(),
        /// The second line of the title. If it, an owner, a document type, an approver or a
        /// revision is set, the title block has all fields of ISO 7200. Default: none.
        pub supplementary_title: String = String::new(),
        /// The legal owner, such as a company. Default: none.
        pub owner: String = String::new(),
        /// The type of the document, such as "Part drawing". Default: none.
        pub document_type: String = String::new(),
        /// The person who approved the drawing. Default: none.
        pub approved_by: String = String::new(),
        /// The revision index, such as "B". Default: none.
        pub revision: String = String::new(),
        /// The sheet number and the number of sheets, as in (2, 5). Default: no number.
        pub sheet_number: Option<(u32, u32)> = None,
        /// The language of the title block's field names. Default: English.
        pub language: TitleBlockLanguage = TitleBlockLanguage::English,
        /// The path of a custom title block, an SVG file with fields such as {title} in its text,
        /// in the scene's folder or below it. Default: the built-in title block.
        pub title_block: Option<String> = None,
        /// The border around the drawing area. Default: a plain line.
        pub frame: SheetFrame = SheetFrame::Plain,
        /// The unit in which lengths are written. Default: inches if the models are in inches or
        /// feet, otherwise millimeters.
        pub dimension_unit: Option<DimensionUnit> = None,
        /// The maximum number of decimals in lengths, from 0 to 6; trailing zeros are omitted.
        /// Default: 2 in millimeters (0 from one meter up), 3 in inches, and sixteenths of an inch
        /// in feet and inches.
        pub decimals: Option<u32> = None,
        /// The decimal separator. Default: a point.
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
        Auto = "The smallest of A4 to A0 that holds the views at 1:1 or larger, or at the given \
                scale. If A0 is too small, the smallest size that allows the same scale as A0.",
    }
}

named_enum! {
    /// The orientation of the paper.
    pub enum PageOrientation as "Orientation" {
        Portrait = "Taller than wide.",
        Landscape = "Wider than tall.",
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
        Isometric = "All axes equally foreshortened.",
        Dimetric = "x and y equally foreshortened: 7° and 42°.",
        Trimetric = "A different foreshortening factor on each axis.",
        ThreeQuarter = "From the front, slightly from the right and from above.",
    }
}
