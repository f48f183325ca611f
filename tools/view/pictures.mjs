// SPDX-License-Identifier: MIT
//
// usage: node tools/view/pictures.mjs FOLDER
// Opens FOLDER/demo.html and puts page.png and crowd-000.png and on into the folder: the page with a limb's overlays, and one loop of
// the crowd alone.
import { writeFile } from "node:fs/promises";
import { chromium } from "../../tests/page/node_modules/playwright-core/index.mjs";

const [folder] = process.argv.slice(2);
const browser = await chromium.launch({
    executablePath: "/usr/bin/chromium-headless-shell",
    args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-gl=angle", "--use-angle=swiftshader"],
});
async function open(options) {
    const page = await browser.newPage({ reducedMotion: "reduce", ...options });  // a still page
    await page.goto(`file://${folder}/demo.html`);
    await page.evaluate(() => window.swivelPage.ready.then(() => {}));
    return page;
}

const page = await open({ viewport: { width: 1280, height: 760 }, colorScheme: "dark" });
await page.evaluate(() => {
    swivelPage.setFrame(60);
    location.hash = `#character=${swivelPage.view.middle}&limb=left_leg`;
    swivelPage.lesson.box.open = true;
    document.querySelectorAll("aside > details").forEach((part) => { part.open = part === swivelPage.lesson.box; });
});
await page.waitForTimeout(500);
await page.screenshot({ path: `${folder}/page.png` });

const crowd = await open({ viewport: { width: 560, height: 280 } });
await crowd.evaluate(() => {
    swivelPage.togglePanel();
    swivelPage.select(null);
    swivelPage.home();
    const { camera, controls } = swivelPage.view;
    camera.position.set(controls.target.x - 3.6, controls.target.y + 2.2, controls.target.z + 6);
    controls.update();
});
for (let frame = 0; frame < 132; frame += 3) {
    const url = await crowd.evaluate((at) => {
        swivelPage.setFrame(at);
        swivelPage.draw();
        return document.querySelector("canvas").toDataURL("image/png");
    }, frame);
    await writeFile(`${folder}/crowd-${String(frame).padStart(3, "0")}.png`, Buffer.from(url.split(",")[1], "base64"));
}
await browser.close();
