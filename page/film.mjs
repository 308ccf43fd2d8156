// Steers the page of `cascade view film.cascade` as a hand would, and takes pictures of what is seen: growth, a slider, a
// stroke, the next stage. Arguments: the browser and the program. Pictures are left in the current folder.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, serve } from "../tests/page/browser.mjs";

const [command, program, script] = process.argv.slice(2);
const { cascade, address } = await serve(program, script);
const browser = await Browser.start(command, join(process.cwd(), "profile"));
const milliseconds_of_picture = 100;
const place = (selector, along = 0.5) => browser.evaluate(
    `(({ x, y, width, height }) => [x + ${along} * width, y + height / 2])(document.querySelector("${selector}").getBoundingClientRect())`);

let taken = 0, next_at = 0;
/// Waits until the next picture is due, and takes it.
async function take() {
    await new Promise((resolve) => setTimeout(resolve, Math.max(0, next_at - performance.now())));
    next_at = Math.max(next_at, performance.now() - milliseconds_of_picture) + milliseconds_of_picture;
    writeFileSync(`${String(taken++).padStart(4, "0")}.png`, await browser.screenshot());
}
async function watch(pictures) { for (let k = 0; k < pictures; ++k) await take(); }

let [hand_x, hand_y] = [830, 650];
async function point(x, y, type = "mouseMoved", is_down = type === "mousePressed") {
    [hand_x, hand_y] = [x, y];
    await browser.evaluate(`Object.assign(window.hand.style, { left: "${x}px", top: "${y}px" })`);
    await browser.call("Input.dispatchMouseEvent", { type, x, y, button: type === "mouseMoved" && !is_down ? "none" : "left", buttons: is_down ? 1 : 0, clickCount: 1 });
}
/// Moves the hand to a position within `pictures` pictures. Its way is an arc of the height `bend`
/// in pixels.
async function move([x, y], pictures, is_down = false, bend = 0) {
    const [from_x, from_y] = [hand_x, hand_y];
    for (let k = 1; k <= 4 * pictures; ++k) {
        const part = k / (4 * pictures), along = is_down ? part : part * part * (3 - 2 * part);
        await point(from_x + along * (x - from_x), from_y + along * (y - from_y) - bend * Math.sin(Math.PI * part), "mouseMoved", is_down);
        if (k % 4 === 0) await take();
    }
}
async function press() { await point(hand_x, hand_y, "mousePressed"); }
async function release() { await point(hand_x, hand_y, "mouseReleased"); }

await browser.call("Emulation.setDeviceMetricsOverride", { width: 1200, height: 760, deviceScaleFactor: 1, mobile: false });
await browser.begin_with({ was_taught: "yes", speed: "-1" });
await browser.call("Page.navigate", { url: address });
await browser.until(`document.querySelectorAll("#stages li").length === 2 && document.querySelectorAll("#controls [type=range]").length > 1`);
await browser.evaluate(`{
    window.hand = document.createElement("div");
    hand.innerHTML = '<svg width="18" height="24" viewBox="0 0 18 24"><path d="M1 1v18l4.5-4 3 7 3-1.3-3-6.7H15z" fill="#111" stroke="#fff" stroke-width="1.3"/></svg>';
    Object.assign(hand.style, { position: "fixed", zIndex: 9, pointerEvents: "none", left: "${hand_x}px", top: "${hand_y}px" });
    document.body.append(hand);
}`);
const kill = "#controls .slider:nth-of-type(2) [type=range]", pattern = "#pattern";
await watch(22);
await move(await place(kill, 0.5), 6);
await press();
await move(await place(kill, 0.72), 5, true);
await release();
await move(await place(pattern, 0.15), 6);
await watch(22);
await press();
await move(await place(pattern, 0.85), 8, true, 120);
await release();
await watch(14);
await move(await place("#next"), 6);
await press();
await release();
await watch(26);
browser.end();
cascade.kill("SIGKILL");
