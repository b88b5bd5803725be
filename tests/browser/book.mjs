// Tests the book in a browser: layout at two widths and in two themes, no requests to other hosts, search in both languages.
//
//   node book.mjs FOLDER       FOLDER contains `en` and `zh`; run by `cargo xtask book --check`

import { readdir } from 'node:fs/promises';
import path from 'node:path';
import { assert, launchBrowser, serveFolder } from './harness.mjs';

const LANGUAGES = ['en', 'zh'];
/** HTML files of an edition that are not book pages. */
const OTHERS = ['print.html', 'toc.html', '404.html', 'index.html'];
/** For each language: a search query, and the page that must be among the first five results. */
const SOUGHT = { en: ['perspective divide', 'points.html'], zh: ['透视除法', 'points.html'] };
const VIEWS = [
  { viewport: { width: 380, height: 800 }, colorScheme: 'dark' },
  { viewport: { width: 1400, height: 900 }, colorScheme: 'light' },
];

let failures = 0;

async function test(name, run) {
  try {
    await run();
  } catch (error) {
    failures += 1;
    console.log(`FAILED ${name}: ${error.message}`);
  }
}

/** Finds elements that overflow the window and do not scroll, and broken figures and formulas. */
function measurePage() {
  const content = document.querySelector('#mdbook-content');
  const scrolls = (element) => ['auto', 'scroll'].includes(getComputedStyle(element).overflowX) && element !== content;
  const isInside = (element) => {
    for (let at = element.parentElement; at && at !== content; at = at.parentElement) if (scrolls(at)) return true;
    return false;
  };
  const sticksOut = (element) => element.getBoundingClientRect().right > innerWidth + 1 && !isInside(element);
  const wide = [...content.querySelectorAll('main *')].filter(sticksOut).slice(0, 3);
  const images = [...content.querySelectorAll('figure img')];
  return {
    language: document.documentElement.lang,
    excess: Math.max(document.documentElement.scrollWidth - innerWidth, content.scrollWidth - content.clientWidth),
    wide: wide.map((element) => `${element.tagName} “${element.textContent.slice(0, 40)}”`),
    broken: images.filter((image) => image.naturalWidth === 0).map((image) => image.src),
    dark: images.filter((image) => getComputedStyle(image).backgroundColor !== 'rgb(255, 255, 255)').length,
    raw: content.querySelector('main').textContent.match(/`\$|\$`|\\frac|\\begin/g) ?? [],
    math: [...content.querySelectorAll('math')].filter((math) => math.getBoundingClientRect().width === 0).length,
  };
}

/** Opens a tab that records requests to other hosts. */
async function openTab(browser, address, view) {
  const page = await browser.newPage(view);
  const foreign = [];
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(address) && !url.startsWith('data:')) foreign.push(url);
  });
  return { page, foreign, width: view.viewport.width };
}

async function testPage({ page, foreign, width }, address, language, name) {
  await page.goto(`${address}${language}/${name}`);
  const found = await page.evaluate(measurePage);
  assert(found.language === language, `lang is ${found.language}`);
  assert(found.excess <= 0, `${width} px: ${found.excess} px too wide: ${found.wide.join(', ')}`);
  assert(found.broken.length === 0, `figures are missing: ${found.broken}`);
  assert(found.dark === 0, `${found.dark} figures without a white background`);
  assert(found.raw.length === 0, `LaTeX source is visible: ${found.raw}`);
  assert(found.math === 0, `${found.math} formulas are invisible`);
  assert(foreign.length === 0, `loaded from other hosts: ${foreign.splice(0)}`);
}

async function testSearch(browser, address, language) {
  const [words, expected] = SOUGHT[language];
  const page = await browser.newPage(VIEWS[1]);
  await page.goto(`${address}${language}/index.html?search=${encodeURIComponent(words)}`);
  await page.locator('#mdbook-searchresults li a').first().waitFor({ timeout: 20000 });
  const links = await page.locator('#mdbook-searchresults li a').evaluateAll((all) => all.slice(0, 5).map((link) => link.getAttribute('href')));
  assert(links.some((link) => link.includes(expected)), `“${words}” finds ${links.join(', ')}`);
  const teaser = await page.locator('#mdbook-searchresults .teaser em').first().textContent();
  assert(teaser.length > 0, `“${words}”: no word is highlighted`);
  const header = await page.locator('#mdbook-searchresults-header').innerText();
  assert(language === 'en' || header.startsWith('找到'), `the number of results is shown as “${header}”`);
  await page.close();
}

const folder = process.argv[2];
const site = await serveFolder(folder);
const browser = await launchBrowser();
let count = 0;
for (const language of LANGUAGES) {
  const names = (await readdir(path.join(folder, language))).filter((name) => name.endsWith('.html') && !OTHERS.includes(name));
  for (const view of VIEWS) {
    const tab = await openTab(browser, site.address, view);
    for (const name of names) await test(`${language}/${name}`, () => testPage(tab, site.address, language, name));
    await tab.page.close();
  }
  await test(`search in ${language}`, () => testSearch(browser, site.address, language));
  count += names.length;
}
await browser.close();
site.stop();
console.log(`${count} pages in a browser, ${failures} failures`);
if (failures > 0) process.exitCode = 1;
