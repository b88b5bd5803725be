// The page's text in English and Chinese. Text about a lesson comes from the engine.

const TEXTS = {
  explorer: ['explorer', '观察流水线'],
  skip: ['Skip to the parameters', '跳到参数'],
  lesson: ['Lesson', '课'],
  previous: ['Previous lesson', '上一课'],
  next: ['Next lesson', '下一课'],
  language: ['Language', '语言'],
  theme: ['Theme', '外观'],
  themeAuto: ['System', '跟随系统'],
  themeLight: ['Light', '浅色'],
  themeDark: ['Dark', '深色'],
  loading: ['Loading …', '正在加载……'],
  parameters: ['Parameters', '参数'],
  limits: ['Use a number from {0} to {1}.', '请输入 {0} 到 {1} 之间的数。'],
  reset: ['Reset', '重置'],
  undo: ['Undo', '撤销'],
  redo: ['Redo', '重做'],
  consequences: ['Consequences', '结果'],
  takeAway: ['Copy and save', '复制与保存'],
  copyLink: ['Copy link', '复制链接'],
  copyCommand: ['Copy as command', '复制为命令'],
  copyScene: ['Copy as scene file', '复制为场景文件'],
  savePicture: ['Save picture (PNG)', '保存图像 (PNG)'],
  saveDrawing: ['Save drawing (SVG)', '保存线图 (SVG)'],
  openModel: ['Open a model or scene', '打开模型或场景'],
  dropHint: [
    'Or drop files on the page: glTF, STL, OBJ, PLY, 3MF. Add the .bin and textures of a .gltf. Files never leave the browser.',
    '也可将文件拖到页面上：glTF、STL、OBJ、PLY、3MF。.gltf 需同时选中其 .bin 与纹理。文件不会离开浏览器。',
  ],
  startModel: [
    'To begin, choose a file below or drop it on the page.',
    '请先在下面选择文件，或将文件拖到页面上。',
  ],
  startNative: ['To begin, start the program with a file: `alberti explore --native MODEL`.', '请先用它启动程序：`alberti explore --native MODEL`。'],
  picture: ['Picture', '图像'],
  pictureLabel: ['Picture from the camera', '相机所见的图像'],
  pictureHint: [
    'Click a pixel to pin the point there, or move the cursor with the arrow keys (finer with Shift) and press Enter.',
    '点击像素即可固定该处的点；也可用方向键移动光标（按住 Shift 更细），再按 Enter。',
  ],
  world: ['World, with the view volume', '世界与视见体'],
  worldLabel: ['The world from outside, with the eye and the view volume', '从外部看世界：视点与视见体'],
  volume: ['Canonical view volume', '规范视见体'],
  volumeLabel: ['The canonical view volume after the divide', '透视除法之后的规范视见体'],
  orbitHint: ['Drag to orbit, or use the arrow keys.', '拖动或用方向键可环绕观察。'],
  depth: ['Depth', '深度'],
  depthLabel: ['Depth buffer value against distance from the eye', '深度缓冲中的深度与到视点距离的关系'],
  depthTable: ['Depth table', '深度表'],
  journey: ['Pinned point in every space', '固定点的变换历程'],
  pinLabel: ['Pinned point', '固定点'],
  space: ['space', '空间'],
  pick: ['Surfaces at the pixel', '该像素处有什么'],
  matrix: ['Matrices', '矩阵'],
  close: ['Close', '关闭'],
  copied: ['Copied.', '已复制。'],
  saved: ['Saved {0}.', '已保存为 {0}。'],
  copyByHand: ['Copy this text', '请复制以下文字'],
  cursorAt: ['pixel {0}, {1}', '像素 {0}, {1}'],
  footer: [
    'This page runs the same code as the program, so saved pictures are identical, byte for byte.',
    '此处一切均由 Alberti 计算，与命令行程序使用同一代码：保存的图像逐字节相同。',
  ],
  native: ['Computed by the server.', '由服务器计算。'],
  noModel: ['None of these files is a model.', '这些文件中没有模型。'],
  noModelHelp: ['Choose a .glb, .gltf, .stl, .obj, .ply, .3mf or .ron file.', '请选择 .glb、.gltf、.stl、.obj、.ply、.3mf 或 .ron 文件。'],
  hugeModel: ['{0} and its files exceed {1} MB.', '{0} 大于 {1} MB。'],
  hugeModelHelp: ['Run the program instead: `alberti explore --native MODEL`.', '请使用程序：`alberti explore --native MODEL`。'],
  died: ['The computation stopped: {0}', '计算中止：{0}'],
  diedHelp: [
    'It restarts with the next change. If it ran out of memory, undo the change or choose a smaller model.',
    '下一次更改时将重新启动。若内存不足，请撤销更改或选择较小的模型。',
  ],
  notStarted: ['The page cannot compute: {0}', '页面无法计算：{0}'],
  notStartedHelp: [
    'Reload the page. If that does not help, use a different browser or run `alberti explore --native`.',
    '请重新加载页面。若仍不行，请换用其他浏览器，或运行 `alberti explore --native`。',
  ],
  badLinkHelp: ['The lesson opens with its default values.', '本课以默认值显示。'],
  style: ['Style', '样式'],
  styleDefault: ['lesson default', '按本课'],
  allSteps: ['Every step with its formulas', '每一步及其公式'],
  inside: ['inside', '在内'],
  clipped: ['clipped', '被裁剪'],
  outside: ['outside', '在外'],
  outcodeInside: ['Outcode {0}: inside all six planes.', '区域码 {0}：在六个平面之内。'],
  outcodeOutside: ['Outcode {0}: outside {1}.', '区域码 {0}：在 {1} 之外。'],
  sources: {
    learnwebgl: ['Learn WebGL', 'Learn WebGL'],
    chapter: ['The chapter on viewing', '教科书“观察”一章'],
    slides: ['The lecture slides', '课件'],
    own: ['Your own model', '自己的模型'],
  },
};

/** Headings and names in explanations, which the engine returns in English. */
const TERMS = {
  'Camera: from the world to view space': '相机：从世界坐标到观察坐标',
  'Projection: from view to clip space': '投影：从观察坐标到裁剪坐标',
  'Outcodes: the planes that each point is outside of': '区域码：在哪些平面之外',
  'The divide by w': '透视除法：除以 w',
  'Viewport: to pixels': '视口变换：到像素',
  eye: '视点',
  gaze: '视线方向',
  'u, to the right': 'u，向右',
  'v, up': 'v，向上',
  'w, against the gaze': 'w，与视线相反',
  'T, which moves the eye to the origin': 'T，视点移到原点',
  'R, with rows u, v, w': 'R，各行为 u、v、w',
  'M_cam, the product': 'M_cam，二者之积',
  view: '观察坐标',
  'distance ahead': '前方距离',
  'it is': '类型',
  'shear, the center line onto the line of sight': '错切，中心线对准视线',
  'scale, sides to x, y = ±distance': '缩放，侧面变为 x, y = ±距离',
  'depth, and w = distance': '深度，且 w = 距离',
  'the whole projection': '完整的投影',
  'projection after M_cam': '投影与 M_cam 之积',
  clip: '裁剪坐标',
  outcode: '区域码',
  ndc: '规范化设备坐标',
  'x, y, depth': 'x, y, 深度',
  pixel: '像素',
};

/** The page's languages. */
export const LANGUAGES = ['en', 'zh'];

let language = 'en';

/** Sets the language of all text. @param {string} chosen */
export function setLanguage(chosen) {
  language = LANGUAGES.includes(chosen) ? chosen : 'en';
  document.documentElement.lang = language === 'zh' ? 'zh-CN' : 'en';
}

export const currentLanguage = () => language;

/** Returns a text of the page with values in place of `{0}` and `{1}`. @param {string} key */
export function text(key, ...values) {
  const words = TEXTS[key][LANGUAGES.indexOf(language)];
  return values.reduce((all, value, i) => all.replace(`{${i}}`, value), words);
}

/** Returns the name of a lesson source. @param {string} source */
export const sourceName = (source) => TEXTS.sources[source]?.[LANGUAGES.indexOf(language)] ?? source;

/** Returns text from the engine, which may be in both languages or only one. @param {any} words */
export const word = (words) => (words && typeof words === 'object' ? (words[language] ?? words.en ?? '') : String(words ?? ''));

/** Turns a message into a sentence with a capital letter and a period. @param {string} message */
export function sentence(message) {
  const words = /^[a-z]+[ ,]/.test(message) ? message[0].toUpperCase() + message.slice(1) : message;
  return words === '' || /[.!?。！？]$/.test(words) ? words : `${words}${language === 'zh' ? '。' : '.'}`;
}

/** Translates a heading or name of an explanation. @param {string} english */
export const term = (english) => (language === 'zh' ? (TERMS[english] ?? english) : english);

/** Fills in the text of all elements with `data-text` or `data-label`. */
export function applyTexts() {
  for (const one of document.querySelectorAll('[data-text]')) one.textContent = text(one.dataset.text);
  for (const one of document.querySelectorAll('[data-label]')) one.setAttribute('aria-label', text(one.dataset.label));
}
