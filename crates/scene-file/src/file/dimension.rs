//! Dimensions of a sheet in a scene file: what is measured, picked by name or by place.

use crate::number::Triple;
use crate::schema::{
    Data, Declared as _, SceneValue, ValueType, named_enum, named_values, scene_enum, scene_struct,
    serde_by_scene_value,
};
use sheet::{DimensionSide, LengthDirection};

serde_by_scene_value! { DimensionsFile }

/// The dimensions of a sheet: a list, or `true` for the overall ones and `false` for none.
#[derive(Clone, PartialEq, Debug)]
pub struct DimensionsFile(pub Vec<DimensionFile>);

impl DimensionsFile {
    /// The overall dimensions.
    #[must_use]
    pub fn overall() -> Self {
        Self(vec![DimensionFile::Overall])
    }

    /// No dimensions.
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

/// Whether values of this type stand in the list of a sheet's dimensions.
pub(crate) fn is_dimensions_list(element: &ValueType) -> bool {
    matches!(element, ValueType::Declared(entry) if entry.name == DimensionFile::ENTRY.name)
}

scene_enum! {
    /// A dimension of a sheet. Lengths are in millimeters or inches of the object, whatever the
    /// scale. A view shows it that shows it true; where none does, it is left out with a warning.
    pub enum DimensionFile as "Dimension" {
        /// Width, height and depth of the whole, outside of all others.
        Overall,
        /// The distance between two points; of an edge or a face the distance is perpendicular to
        /// it.
        Length {
            /// The first point, edge or face.
            from: PickFile,
            /// The other one; two edges, two faces, or an edge and a face must be parallel.
            to: PickFile,
            /// The direction of measurement. Default: `Aligned`.
            direction: LengthDirection = LengthDirection::Aligned,
            /// The view. Default: the first that shows the length true.
            view: Option<DimensionView> = None,
            /// The side of the part on which the dimension line stands. Default: the one with
            /// shorter extension lines.
            side: Option<DimensionSide> = None,
            /// The most decimal places, up to 6. Default: 2 for millimeters, 3 for inches.
            decimals: Option<u32> = None,
        },
        /// Lengths between neighboring points, on one dimension line.
        Chain {
            /// At least two points; their order does not matter but for the direction of an aligned
            /// chain, which is from the first to the last.
            points: Vec<PickFile>,
            /// The direction of measurement. Default: `Aligned`.
            direction: LengthDirection = LengthDirection::Aligned,
            /// The view. Default: the first that shows the lengths true.
            view: Option<DimensionView> = None,
            /// The side of the part on which the dimension line stands. Default: the one with
            /// shorter extension lines.
            side: Option<DimensionSide> = None,
            /// The most decimal places, up to 6. Default: 2 for millimeters, 3 for inches.
            decimals: Option<u32> = None,
        },
        /// Lengths from one point to each of several others, on parallel dimension lines.
        Baseline {
            /// The point from which all are measured.
            from: PickFile,
            /// The others, at least one; an aligned length is measured towards the last.
            to: Vec<PickFile>,
            /// The direction of measurement. Default: `Aligned`.
            direction: LengthDirection = LengthDirection::Aligned,
            /// The view. Default: the first that shows the lengths true.
            view: Option<DimensionView> = None,
            /// The side of the part on which the dimension lines stand. Default: the one with
            /// shorter extension lines.
            side: Option<DimensionSide> = None,
            /// The most decimal places, up to 6. Default: 2 for millimeters, 3 for inches.
            decimals: Option<u32> = None,
        },
        /// The diameter of a circle, with Ø: an arrow onto the circle where a view shows one, else
        /// a length across it.
        Diameter {
            /// The circle or arc.
            circle: PlaceFile,
            /// The view. Default: the first that shows the circle as one, else from its side.
            view: Option<DimensionView> = None,
            /// The most decimal places, up to 6. Default: 2 for millimeters, 3 for inches.
            decimals: Option<u32> = None,
        },
        /// The radius of a circle or arc, with R, in a view that shows it as one.
        Radius {
            /// The circle or arc.
            circle: PlaceFile,
            /// The view. Default: the first that shows the circle as one.
            view: Option<DimensionView> = None,
            /// The most decimal places, up to 6. Default: 2 for millimeters, 3 for inches.
            decimals: Option<u32> = None,
        },
        /// The diameters of the largest full circles, each diameter once.
        LargestDiameters {
            /// How many, from 1 to 50. Default: 3.
            count: u32 = 3,
            /// The most decimal places, up to 6. Default: 2 for millimeters, 3 for inches.
            decimals: Option<u32> = None,
        },
        /// The angle between two edges or two faces, or at a vertex between the directions to two
        /// points.
        Angle {
            /// The first edge, face or point.
            from: PickFile,
            /// The other one.
            to: PickFile,
            /// The vertex, between points. Default: where the edges or faces meet.
            vertex: Option<PickFile> = None,
            /// The view. Default: the first that shows the angle true.
            view: Option<DimensionView> = None,
            /// The most decimal places of degrees, up to 6. Default: 2.
            decimals: Option<u32> = None,
        },
    }
}

scene_enum! {
    /// A part of the models, picked by its place or by the name of its node.
    pub enum PickFile as "Pick" {
        /// A point of the world.
        Point(Triple),
        /// A point of the box around all models: (0, 0, 0) is the corner with the least x, y and z,
        /// (1, 1, 1) that with the greatest.
        Fraction(Triple),
        /// A point of the box around a node and everything below it.
        Node {
            /// The name of the node, or of a mesh whose node has no name.
            name: String,
            /// Which of several nodes with this name, from 0. Default: 0.
            number: usize = 0,
            /// The point of the box, as for `Fraction`. Default: (0.5, 0.5, 0.5), its center.
            fraction: Triple = HALVES,
        },
        /// The nearest vertex.
        Vertex(PlaceFile),
        /// The nearest edge: a crease of more than 30 degrees or a boundary. As a point it is the
        /// nearest one.
        Edge(PlaceFile),
        /// The center of the nearest circle or arc of edges.
        Circle(PlaceFile),
        /// The plane of the nearest triangle. As a point it is the nearest one.
        Face(PlaceFile),
    }
}

/// The center of a box.
const HALVES: Triple = Triple([0.5; 3]);

scene_struct! {
    /// A place at which the nearest part is picked: a point, or one of a box.
    pub struct PlaceFile as "Place" {
        /// A point of the world. Default: that of `fraction`.
        pub near: Option<Triple> = None,
        /// A point of the box around the node, or around all models without one: (0, 0, 0) is the
        /// corner with the least x, y and z, (1, 1, 1) that with the greatest.
        /// Default: (0.5, 0.5, 0.5), its center.
        pub fraction: Option<Triple> = None,
        /// The name of a node: only it and everything below it is looked at. Default: all models.
        pub node: Option<String> = None,
        /// Which of several nodes with this name, from 0. Default: 0.
        pub number: usize = 0,
    }
}

named_enum! {
    /// A view of a sheet that has dimensions.
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
    /// The side of a part on which a dimension line stands.
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
        Horizontal = "Across the view, from left to right.",
        Vertical = "Up the view.",
    }
}
