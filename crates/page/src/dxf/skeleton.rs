//! The sections and tables around the entities, required in every R2000 DXF file.
//!
//! The handles of tables, dictionaries and layouts are fixed, with the values that other programs
//! use. The handles of line types, layers and entities start at [`FIRST_LINE_TYPE`].

use super::DxfUnit;
use super::entities::Extents;
use super::layers::LayerTable;
use super::tags::TagWriter;
use glam::DVec2;

/// The block record of the model space, which owns the entities.
pub(super) const MODEL_SPACE: u32 = 0x17;

/// The first handle of dashed line types.
const FIRST_LINE_TYPE: u32 = 0x100;
/// The first handle of layers.
const FIRST_LAYER: u32 = 0x1000;
/// The first handle of entities.
pub(super) const FIRST_ENTITY: u32 = 0x100_0000;

/// Writes the `HEADER` and `CLASSES` sections.
pub(super) fn write_header(
    tags: &mut TagWriter,
    unit: Option<DxfUnit>,
    [low, high]: Extents,
    next_handle: u32,
) {
    tags.begin_section("HEADER");
    tags.tags("9=$ACADVER|1=AC1015|9=$ACADMAINTVER|70=6|9=$DWGCODEPAGE|3=ANSI_1252");
    tags.tags("9=$INSBASE|10=0.0|20=0.0|30=0.0");
    for (name, corner) in [("$EXTMIN", low), ("$EXTMAX", high)] {
        tags.tag(9, name);
        tags.point_in_space(10, corner);
    }
    for (name, corner) in [("$LIMMIN", low), ("$LIMMAX", high)] {
        tags.tag(9, name);
        tags.point(10, corner);
    }
    tags.tags("9=$LTSCALE|40=1.0|9=$TEXTSTYLE|7=Standard|9=$CLAYER|8=0|9=$CELTYPE|6=ByLayer");
    tags.tags("9=$CECOLOR|62=256|9=$CELTSCALE|40=1.0|9=$LUNITS|70=2|9=$LUPREC|70=4|9=$AUNITS|70=0");
    tags.tags("9=$CELWEIGHT|370=-1|9=$LWDISPLAY|290=1|9=$PSTYLEMODE|290=1|9=$PSLTSCALE|70=0");
    let imperial = matches!(unit, Some(DxfUnit::Inch | DxfUnit::Foot));
    tags.tag(9, "$MEASUREMENT");
    tags.tag(70, u8::from(!imperial));
    tags.tag(9, "$INSUNITS");
    tags.tag(70, unit.map_or(0, unit_code));
    tags.tag(9, "$HANDSEED");
    tags.handle(5, next_handle);
    tags.end_section();
    tags.begin_section("CLASSES");
    for (name, class) in [
        ("ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault"),
        ("ACDBPLACEHOLDER", "AcDbPlaceHolder"),
        ("LAYOUT", "AcDbLayout"),
    ] {
        tags.tag(0, "CLASS");
        tags.tag(1, name);
        tags.tag(2, class);
        tags.tags("3=ObjectDBX Classes|90=0|280=0|281=0");
    }
    tags.end_section();
}

/// Returns the code of a unit in `$INSUNITS`.
const fn unit_code(unit: DxfUnit) -> u8 {
    match unit {
        DxfUnit::Inch => 1,
        DxfUnit::Foot => 2,
        DxfUnit::Millimeter => 4,
        DxfUnit::Centimeter => 5,
        DxfUnit::Meter => 6,
        DxfUnit::Micrometer => 13,
    }
}

/// Writes the `TABLES` and `BLOCKS` sections.
pub(super) fn write_tables(tags: &mut TagWriter, layers: &LayerTable, bounds: Extents) {
    let [layer_count, dashed_count] = layers.counts();
    tags.begin_section("TABLES");
    begin_table(tags, "VPORT", 0x8, 1);
    write_viewport(tags, bounds);
    tags.tag(0, "ENDTAB");
    begin_table(tags, "LTYPE", 0x2, 3 + dashed_count);
    for (handle, name) in [(0x24, "ByBlock"), (0x25, "ByLayer"), (0x26, "Continuous")] {
        begin_record(tags, "LTYPE", handle, 0x2, "AcDbLinetypeTableRecord");
        tags.tag(2, name);
        tags.tags("70=0|3=|72=65|73=0|40=0.0");
    }
    layers.write_line_types(tags, 0x2, FIRST_LINE_TYPE);
    tags.tag(0, "ENDTAB");
    begin_table(tags, "LAYER", 0x1, 1 + layer_count);
    begin_record(tags, "LAYER", 0x27, 0x1, "AcDbLayerTableRecord");
    tags.tags("2=0|70=0|62=7|6=Continuous|370=-3|390=13");
    layers.write_layers(tags, 0x1, FIRST_LAYER);
    tags.tag(0, "ENDTAB");
    begin_table(tags, "STYLE", 0x5, 1);
    begin_record(tags, "STYLE", 0x29, 0x5, "AcDbTextStyleTableRecord");
    tags.tags("2=Standard|70=0|40=0.0|41=1.0|50=0.0|71=0|42=2.5|3=txt|4=|0=ENDTAB");
    begin_table(tags, "VIEW", 0x7, 0);
    tags.tag(0, "ENDTAB");
    begin_table(tags, "UCS", 0x6, 0);
    tags.tag(0, "ENDTAB");
    begin_table(tags, "APPID", 0x3, 1);
    begin_record(tags, "APPID", 0x2A, 0x3, "AcDbRegAppTableRecord");
    tags.tags("2=ACAD|70=0|0=ENDTAB");
    begin_table(tags, "DIMSTYLE", 0x4, 1);
    tags.tags("100=AcDbDimStyleTable|0=DIMSTYLE|105=2B|330=4|100=AcDbSymbolTableRecord");
    tags.tags("100=AcDbDimStyleTableRecord|2=Standard|70=0|0=ENDTAB");
    begin_table(tags, "BLOCK_RECORD", 0x9, 2);
    for (handle, name, layout) in
        [(MODEL_SPACE, "*Model_Space", 0x1A), (0x1B, "*Paper_Space", 0x1E)]
    {
        begin_record(tags, "BLOCK_RECORD", handle, 0x9, "AcDbBlockTableRecord");
        tags.tag(2, name);
        tags.handle(340, layout);
    }
    tags.tag(0, "ENDTAB");
    tags.end_section();
    tags.begin_section("BLOCKS");
    for (handle, owner, name) in [(0x18, MODEL_SPACE, "*Model_Space"), (0x1C, 0x1B, "*Paper_Space")]
    {
        write_block(tags, handle, owner, name);
    }
    tags.end_section();
}

/// Begins a table.
fn begin_table(tags: &mut TagWriter, name: &str, handle: u32, count: usize) {
    tags.tag(0, "TABLE");
    tags.tag(2, name);
    tags.handle(5, handle);
    tags.tags("330=0|100=AcDbSymbolTable");
    tags.tag(70, count);
}

/// Begins a record of a table.
fn begin_record(tags: &mut TagWriter, kind: &str, handle: u32, table: u32, class: &str) {
    tags.tag(0, kind);
    tags.handle(5, handle);
    tags.handle(330, table);
    tags.tag(100, "AcDbSymbolTableRecord");
    tags.tag(100, class);
}

/// Writes the initial view, which shows the whole drawing.
fn write_viewport(tags: &mut TagWriter, [low, high]: Extents) {
    begin_record(tags, "VPORT", 0x23, 0x8, "AcDbViewportTableRecord");
    tags.tags("2=*Active|70=0|10=0.0|20=0.0|11=1.0|21=1.0");
    tags.point(12, (low + high) * 0.5);
    tags.tags("13=0.0|23=0.0|14=10.0|24=10.0|15=10.0|25=10.0|16=0.0|26=0.0|36=1.0");
    tags.tags("17=0.0|27=0.0|37=0.0");
    let aspect = 1.5;
    let size = high - low;
    tags.number(40, size.y.max(size.x / aspect).max(1e-6) * 1.05);
    tags.number(41, aspect);
    tags.tags("42=50.0|43=0.0|44=0.0|50=0.0|51=0.0|71=0|72=1000|73=1|74=3|75=0|76=0|77=0|78=0");
    tags.tags("281=0|65=0|146=0.0");
}

/// Writes an empty block. The entities of the model space are in the `ENTITIES` section.
fn write_block(tags: &mut TagWriter, handle: u32, owner: u32, name: &str) {
    tags.tag(0, "BLOCK");
    tags.handle(5, handle);
    tags.handle(330, owner);
    tags.tags("100=AcDbEntity|8=0|100=AcDbBlockBegin");
    tags.tag(2, name);
    tags.tags("70=0|10=0.0|20=0.0|30=0.0");
    tags.tag(3, name);
    tags.tags("1=|0=ENDBLK");
    tags.handle(5, handle + 1);
    tags.handle(330, owner);
    tags.tags("100=AcDbEntity|8=0|100=AcDbBlockEnd");
}

/// Writes the `OBJECTS` section: the named dictionaries and two layouts.
pub(super) fn write_objects(tags: &mut TagWriter, bounds: Extents) {
    tags.begin_section("OBJECTS");
    tags.tags("0=DICTIONARY|5=A|330=0|100=AcDbDictionary|281=1|3=ACAD_GROUP|350=C");
    tags.tags("3=ACAD_LAYOUT|350=D|3=ACAD_MLINESTYLE|350=10|3=ACAD_PLOTSETTINGS|350=11");
    tags.tags("3=ACAD_PLOTSTYLENAME|350=12");
    for (handle, entries) in [
        ("C", ""),
        ("D", "3=Model|350=1A|3=Layout1|350=1E"),
        ("10", "3=Standard|350=22"),
        ("11", ""),
    ] {
        tags.tag(0, "DICTIONARY");
        tags.tag(5, handle);
        tags.tags("330=A|100=AcDbDictionary|281=1");
        tags.tags(entries);
    }
    tags.tags("0=ACDBDICTIONARYWDFLT|5=12|330=A|100=AcDbDictionary|281=1|3=Normal|350=13");
    tags.tags("100=AcDbDictionaryWithDefault|340=13|0=ACDBPLACEHOLDER|5=13|330=12");
    tags.tags("0=MLINESTYLE|5=22|330=10|100=AcDbMlineStyle|2=Standard|70=0|3=|62=256|51=90.0");
    tags.tags("52=90.0|71=2|49=0.5|62=256|6=BYLAYER|49=-0.5|62=256|6=BYLAYER");
    for (handle, name, tab, block) in [(0x1A, "Model", 0, MODEL_SPACE), (0x1E, "Layout1", 1, 0x1B)]
    {
        tags.tag(0, "LAYOUT");
        tags.handle(5, handle);
        tags.tags("330=D|100=AcDbPlotSettings|1=|4=A3|6=|40=7.5|41=20.0|42=7.5|43=20.0|44=420.0");
        tags.tags("45=297.0|46=0.0|47=0.0|48=0.0|49=0.0|140=0.0|141=0.0|142=1.0|143=1.0");
        // 1024: settings for the model tab.
        tags.tag(70, if tab == 0 { 1024 } else { 0 });
        tags.tags("72=1|73=0|74=5|7=|75=16|147=1.0|148=0.0|149=0.0|100=AcDbLayout");
        tags.tag(1, name);
        tags.tag(70, 1);
        tags.tag(71, tab);
        let [low, high] = if tab == 0 { bounds } else { [DVec2::ZERO, DVec2::new(420.0, 297.0)] };
        tags.point(10, low);
        tags.point(11, high);
        tags.tags("12=0.0|22=0.0|32=0.0");
        tags.point_in_space(14, low);
        tags.point_in_space(15, high);
        tags.tags("146=0.0|13=0.0|23=0.0|33=0.0|16=1.0|26=0.0|36=0.0|17=0.0|27=1.0|37=0.0|76=1");
        tags.handle(330, block);
    }
    tags.end_section();
}
