//! Dimensions of a sheet in a scene file: lengths and angles between parts picked by name or
//! position.

use crate::number::Triple;
use crate::schema::{
    Data, Declared as _, SceneValue, ValueType, named_enum, named_values, scene_enum, scene_struct,
    serde_by_scene_value,
};
use sheet::{DimensionSide, LengthDirection};

serde_by_scene_value! { DimensionsFile }

/// The dimensions of a sheet: a list, `true` for the overall dimensions, or `false` for none.
#[derive(Clone, PartialEq, Debug)]
pub struct DimensionsFile(pub Vec<DimensionFile>);

impl DimensionsFile {
    /// Returns the overall dimensions.
    #[must_use]
    pub fn overall() -> Self {
        Self(vec![DimensionFile::Overall])
    }

    /// Returns an empty list of dimensions.
    #[must_use]
    pub const fn none() -> Self {
        Self(Vec::new())
    }
}

impl SceneValue for DimensionsFile {
    fn value_type() -> ValueType {
        Vec::<DimensionFile>::value_type()
    }

    fn from_data(data: &Data) -> Result<Self, String> {
        match data {
            Data::Bool(true) => Ok(Self::overall()),
            Data::Bool(false) => Ok(Self::none()),
            list => Vec::from_data(list).map(Self),
        }
    }

    fn to_data(&self) -> Data {
        match self.0.as_slice() {
            [] => Data::Bool(false),
            [DimensionFile::Overall] => Data::Bool(true),
            _ => self.0.to_data(),
        }
    }
}

/// Whether `element` is the element type of a sheet's list of dimensions.
pub(crate) fn is_dimensions_list(element: &ValueType) -> bool {
    matches!(element, ValueType::Declared(entry) if entry.name == DimensionFile::ENTRY.name)
}

scene_enum! {
    /// A dimension on a sheet. Lengths are measured on the object, in millimeters or inches,
    /// regardless of the scale. A dimension is placed in a view that shows its true size; without
    /// such a view, it is omitted with a warning.
    pub enum DimensionFile as "Dimension" {
        /// The overall width, height and depth, placed outside all other dimensions.
        Overall,
        /// The distance between two points, or the perpendicular distance from an edge or a face.
        Length {
            /// The first point, edge or face.
            from: PickFile,
            /// The second point, edge or face. Two edges, two faces, or an edge and a face must be
            /// parallel.
            to: PickFile,
            /// The direction of measurement. Default: `Aligned`.
            direction: LengthDirection = LengthDirection::Aligned,
            /// The view. Default: the first that shows the true length.
            view: Option<DimensionView> = None,
            /// The side of the part on which the dimension line is placed. Default: the one with
            /// the shorter extension lines.
            side: Option<DimensionSide> = None,
            /// The maximum number of decimal places, up to 6. Default: 2 for millimeters, 3 for
            /// inches.
            decimals: Option<u32> = None,
        },
        /// Lengths between neighboring points, on a single dimension line.
        Chain {
            /// At least two points. Their order matters only for the direction of an aligned chain,
            /// which runs from the first to the last.
            points: Vec<PickFile>,
            /// The direction of measurement. Default: `Aligned`.
            direction: LengthDirection = LengthDirection::Aligned,
            /// The view. Default: the first that shows the true lengths.
            view: Option<DimensionView> = None,
            /// The side of the part on which the dimension line is placed. Default: the one with
            /// the shorter extension lines.
            side: Option<DimensionSide> = None,
            /// The maximum number of decimal places, up to 6. Default: 2 for millimeters, 3 for
            /// inches.
            decimals: Option<u32> = None,
        },
        /// Lengths from one point to each of several others, on parallel dimension lines.
        Baseline {
            /// The point from which all lengths are measured.
            from: PickFile,
            /// The other points, at least one; an aligned length is measured toward the last.
            to: Vec<PickFile>,
            /// The direction of measurement. Default: `Aligned`.
            direction: LengthDirection = LengthDirection::Aligned,
            /// The view. Default: the first that shows the true lengths.
            view: Option<DimensionView> = None,
            /// The side of the part on which the dimension lines are placed. Default: the one with
            /// the shorter extension lines.
            side: Option<DimensionSide> = None,
            /// The maximum number of decimal places, up to 6. Default: 2 for millimeters, 3 for
            /// inches.
            decimals: Option<u32> = None,
        },
        /// The diameter of a circle, marked Ø. It is an arrow to the circle in a view that shows
        /// its true shape, otherwise a length across it.
        Diameter {
            /// The circle, or an arc of at least half a turn.
            circle: PlaceFile,
            /// The view. Default: the first that shows it as a circle, otherwise a view from the
            /// side.
            view: Option<DimensionView> = None,
            /// The maximum number of decimal places, up to 6. Default: 2 for millimeters, 3 for
            /// inches.
            decimals: Option<u32> = None,
        },
        /// The radius of a circle or arc, marked R, in a view that shows it as a circle.
        Radius {
            /// The circle or arc.
            circle: PlaceFile,
            /// The view. Default: the first that shows it as a circle.
            view: Option<DimensionView> = None,
            /// The maximum number of decimal places, up to 6. Default: 2 for millimeters, 3 for
            /// inches.
            decimals: Option<u32> = None,
        },
        /// The diameters of the largest full circles, without repeats.
        LargestDiameters {
            /// The number of diameters, from 1 to 50. Default: 3.
            count: u32 = 3,
            /// The maximum number of decimal places, up to 6. Default: 2 for millimeters, 3 for
            /// inches.
            decimals: Option<u32> = None,
        },
        /// The angle between two edges or two faces, or the angle at a vertex between the
        /// directions to two points.
        Angle {
            /// The first edge, face or point.
            from: PickFile,
            /// The second edge, face or point.
            to: PickFile,
            /// The vertex of an angle between points. Default: where the edges or faces meet.
            vertex: Option<PickFile> = None,
            /// The view. Default: the first that shows the true angle.
            view: Option<DimensionView> = None,
            /// The maximum number of decimal places in degrees, up to 6. Default: 2.
            decimals: Option<u32> = None,
        },
    }
}

scene_enum! {
    /// A part of the models, picked by its position or by the name of its node.
    pub enum PickFile as "Pick" {
        /// A point in the world.
        Point(Triple),
        /// A point in the box around all models: (0, 0, 0) is the corner with the smallest x, y and
        /// z, (1, 1, 1) the one with the largest.
        Fraction(Triple),
        /// A point in the box around a node and all its descendants.
        Node {
            /// The name of the node, or of a mesh whose node has no name.
            name: String,
            /// The index among the nodes with this name, from 0. Default: 0.
            number: usize = 0,
            /// The point in the box, as for `Fraction`. Default: (0.5, 0.5, 0.5), its center.
            fraction: Triple = HALVES,
        },
        /// The nearest vertex.
        Vertex(PlaceFile),
        /// The nearest edge: a crease of more than 30 degrees or a boundary. Used as a point, it is
        /// the nearest point on the edge.
        Edge(PlaceFile),
        /// The center of the nearest circle or arc formed by edges.
        Circle(PlaceFile),
        /// The plane of the nearest triangle. Used as a point, it is the nearest point on the
        /// triangle.
        Face(PlaceFile),
    }
}

/// The center of a box.
const HALVES: Triple = Triple([0.5; 3]);

scene_struct! {
    /// A position near which a part is picked: a point, or a point in a box.
    pub struct PlaceFile as "Place" {
        /// A point in the world. Default: from `fraction`.
        pub near: Option<Triple> = None,
        /// A point in the box around the node, or around all models without one: (0, 0, 0) is the
        /// corner with the smallest x, y and z, (1, 1, 1) the one with the largest. Default: (0.5,
        /// 0.5, 0.5), its center.
        pub fraction: Option<Triple> = None,
        /// The name of a node; only it and its descendants are searched. Default: all models.
        pub node: Option<String> = None,
        /// The index among the nodes with this name, from 0. Default: 0.
        pub number: usize = 0,
    }
}

named_enum! {
    /// A sheet view that can have dimensions.
    pub enum DimensionView as "DimensionView" {
        Front = "From the front.",
        Back = "From the back.",
        Left = "From the left.",
        Right = "From the right.",
        Top = "From above.",
        Bottom = "From below.",
    }
}

named_values! {
    /// The side of a part on which a dimension line is placed.
    DimensionSide as "DimensionSide" {
        Above = "Above the part.",
        Below = "Below the part.",
        Left = "To the left of the part.",
        Right = "To the right of the part.",
    }
}

named_values! {
    /// The direction along which a length is measured.
    LengthDirection as "LengthDirection" {
        Aligned = "From the first point to the last.",
        Horizontal = "Horizontally in the view, from left to right.",
        Vertical = "Vertically in the view, from bottom to top.",
    }
}
