// The page: connects text, sliders, pattern and stages of a session.
import { EngineLine } from "./carried_engine";
import { Brush } from "./brush";
import { Answer, Connection, Explanation, KnownName, Message, Palette, Script, Snapshot } from "./connection";
import { download } from "./download";
import { Editor } from "./editor";
import type { NameUses } from "./editor_names";
import { show_engine } from "./engine_line";
import { Failure } from "./failure";
import { Help } from "./help";
import { obey_keys } from "./keys";
import { speak } from "./languages";
import { Lesson } from "./lesson";
import { Library } from "./library";
import { Gestures } from "./gestures";
import { LinkDialog } from "./link";
import { script_of_address, wrong_link } from "./linked_script";
import { LookControls } from "./look";
import { Measure } from "./measure";
import { send_model, take_drops, with_model } from "./models";
import { Pace } from "./pace";
import { Pattern } from "./pattern";
import { picture_fields } from "./picture_fields";
import { PlaneView } from "./plane_view";
import { Points } from "./points";
import { Pointed } from "./pointed";
import { close_popups } from "./popups";
import { Preparing } from "./preparing";
import { Progress } from "./progress";
import { Recording } from "./recording";
import { Slices } from "./slices";
import { ModelSaver } from "./save_model";
import { show_sliders } from "./sliders";
import { Stages } from "./stages";
import { SolidView } from "./solid_view";
import { in_words } from "./words";

const element = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const button = (id: string) => element<HTMLButtonElement>(id);

speak(element("language"));
const has_shaders = !location.search.includes("2d");
const solid = new SolidView(element<HTMLCanvasElement>("solid"), has_shaders);
const pattern = new Pattern(element<HTMLCanvasElement>("pattern"), solid, has_shaders);
const pointed = new Pointed(pattern);
const look = new LookControls(() => pattern.draw());
pattern.look = look.look;
pattern.drawn = (shown) => {
    look.show(shown);
    show_marks();
};
const palette_choice = element<HTMLSelectElement>("palette");
let palettes: Palette[] = [];
let is_text_open = false;  ///< Whether the text in the editor is not the session's script.
let replaced_script: number | undefined;  ///< The script that the editor's text replaced, until its pattern is shown.
let is_drawing = false;
let was_opened = false;
let is_to_start = false;  ///< Whether to start the run when a snapshot shows its beginning.
let noticed_until = 0;
const preparing = new Preparing();

/// The script in the link by which the page was opened. The link must contain the session's token, so no other site can
/// send a script.
const linked = EngineLine.is_carried || !/token=.*&script=/.test(location.hash) ? undefined
    : script_of_address().catch(() => void notice(in_words(wrong_link), true, 10));
addEventListener("hashchange", () => location.reload());

const connection = new Connection({
    palettes(list) {
        palettes = list;
        if (palette_choice.options.length === 0) {
            palette_choice.append(...list.map(({ name }) => new Option(name.replaceAll("_", " "), name)));
            palette_choice.value = localStorage.getItem("palette") ?? "viridis";
            if (!palette_choice.value) palette_choice.selectedIndex = 0;
        }
        choose_palette();
    },
    systems(systems) {
        library.fill(systems);
        button("systems").hidden = false;
    },
    script: show_script,
    snapshot(snapshot) {
        pace.see(snapshot);
        if (pace.is_between_rows) return connection.next_snapshot();
        pattern.snapshot = snapshot;
        const is_start = snapshot.stage === 1 && snapshot.steps === 0;
        // A new session starts when its page opens, or when a script is chosen.
        if (!was_opened && linked) void linked.then((text) => text && show_new(text));
        else if (!was_opened && is_start && !snapshot.can_undo) {
            if (library.is_filled) library.open();
            else is_to_start = true;
        }
        was_opened = true;
        if (!library.is_open) help.greet();
        if (is_to_start && is_start) {
            is_to_start = false;
            start_run();
        }
        if (performance.now() > noticed_until) notice("");
        if (is_drawing) return;
        is_drawing = true;
        requestAnimationFrame(() => {
            is_drawing = false;
            // The next snapshot comes while this one is drawn.
            connection.next_snapshot();
            pattern.draw();
            slices.show(pattern.snapshot!);
            void measure.look_at(pattern.snapshot!);
            lesson.look_at(pattern.snapshot!);
            want_surface(pattern.snapshot!);
            preparing.blank = pattern.snapshot!.is_model && solid.is_possible && !pattern.is_solid;
            show_state(pattern.snapshot!);
            if (!pattern.canvas.hidden) keep_what_is_seen();
        });
    },
    surface(surface) {
        solid.take(surface);
        pattern.draw();
    },
    engine: show_engine,
    progress: (doing, part) => preparing.tell(doing, part),
    lost(reason) {
        preparing.tell("");
        asked_surface = 0;
        notice(reason, true);
    },
    refused: (why) => notice(in_words(why), true, 10),
});

const measure = new Measure(pattern, (what, fields) => connection.ask(what, fields));
function keep_what_is_seen() {
    if (!pattern.snapshot) return;
    recording.take(pattern.snapshot.number);
    strip.keep_picture(pattern.snapshot, pattern.seen);
}
solid.drawn = () => {
    preparing.blank = false;
    keep_what_is_seen();
};
function show_marks() {
    pointed.show();
    measure.show_mark();
    failure.show_mark();
}

const failure = new Failure(pattern, (what, fields) => void ask(what, fields));
const strip = new Stages((stage) => void ask("go_to_stage", { stage }));
const help = new Help();
const recording = new Recording(() => pattern.seen, () => name_of_file(), (is_movie, are_frames) => {
    button("movie").ariaPressed = String(is_movie);
    button("frames").ariaPressed = String(are_frames);
    element("save").toggleAttribute("data-recording", is_movie || are_frames);
});
let asked_surface = 0;
function want_surface({ surface, is_model, cells }: Snapshot) {
    button("flat").hidden = surface === 0 || is_model || cells !== undefined || !solid.is_possible;
    if (cells?.extent && !solid.is_possible) notice("Cells that crawl need WebGL2, which this browser does not offer.", true, 60);
    // A floor may have replaced the surface.
    if (surface === 0 || (surface === asked_surface && solid.surface?.number !== 0)) return;
    asked_surface = surface;
    if (solid.is_possible) connection.ask_surface();
    else if (is_model) notice("Models need WebGL2, which this browser does not offer.", true, 60);
}

const slices = new Slices((fields) => ask("slice", fields));

/// Replaces the script and starts the run.
async function show_new(text: string) {
    is_text_open = false;
    await pace.stop();
    const answer = await ask("text", { text });
    if (!answer.is_done) return;
    // Without this, stages and species with the old names would keep their values.
    await ask("restart");
    is_to_start = true;
}
const library = new Library(show_new);
const link = new LinkDialog(() => connection.token);

const engine_help = {
    names: async (text: string) => (await connection.ask<{ names?: KnownName[] }>("names", { text })).names ?? [],
    explain: (text: string) => connection.ask<Explanation>("explain", { text }),
    uses: (text: string, byte: number) => connection.ask<NameUses>("uses", { text, byte }),
    rename: (text: string, byte: number, name: string) => connection.ask<{ text?: string }>("rename", { text, byte, name }),
    tell: (why: string | Message) => notice(typeof why === "string" ? why : in_words(why), typeof why !== "string", 6),
};
function mark_typing() {
    replaced_script = undefined;
    element("text").ariaBusy = "true";
}
const editor = new Editor(element("editor"), engine_help, mark_typing, async (text) => {
    is_text_open = true;
    const before = pattern.snapshot?.script, asked = connection.ask("text", { text });
    void pace.send(asked);
    const answer = await asked;
    if (text !== editor.text) return;
    replaced_script = answer.is_done && pattern.snapshot?.script === before ? before : undefined;
    if (replaced_script === undefined) element("text").ariaBusy = "false";
    is_text_open = !answer.is_done;
    show_messages(answer.messages);
    if (!answer.messages.some(({ is_error, hint }) => is_error && hint)) return;
    const { fixes } = await connection.ask<{ fixes: (string | null)[] }>("fixes", { text });
    if (text === editor.text) show_messages(answer.messages, fixes);
}, () => notice("This part of the exercise is locked.", false, 5));
const lesson = new Lesson((what, fields) => connection.ask(what, fields), () => element<HTMLInputElement>("show").value);

/// Shows a notice for some seconds, or until the next notice.
function notice(text: string, is_wrong = false, seconds = 0) {
    noticed_until = performance.now() + 1000 * seconds;
    element("notice").textContent = text;
    element("notice").classList.toggle("wrong", is_wrong);
    if (seconds === 0) return;
    setTimeout(() => {
        // Without a pattern, the notice remains.
        if (performance.now() < noticed_until || !pattern.snapshot) return;
        notice("");
        show_state(pattern.snapshot);
    }, 1000 * seconds + 100);
}

/// Shows messages, with a button for each of the first errors for which the engine has found a correction.
function show_messages(messages: Message[], fixes: (string | null)[] = []) {
    editor.show(messages);
    element("messages").replaceChildren(...messages.filter((m) => m.is_error).slice(0, 5).map((m, k) => {
        const line = document.createElement("p"), fix = fixes[k];
        line.textContent = in_words(m);
        if (!fix || !m.from || !m.to) return line;
        const use = Object.assign(document.createElement("button"), { textContent: `write ${fix}` });
        use.addEventListener("click", () => editor.replace(m.from!, m.to!, fix));
        line.append(" ", use);
        return line;
    }));
}

/// Sends a request, and shows the message if it is refused.
async function ask<Reply = object>(what: string, fields: Record<string, unknown> = {}): Promise<Answer & Reply> {
    const answer = await connection.ask<Reply>(what, fields);
    if (!answer.is_done && answer.messages.length > 0) notice(in_words(answer.messages[0]), true, 5);
    return answer;
}

const pace = new Pace(ask);
const progress = new Progress(pace);
/// Sends a number or a stroke, after which a pattern that has ended continues.
async function change(what: string, fields: Record<string, unknown>) {
    const answer = await ask(what, fields);
    if (answer.is_done) pace.touch();
    return answer;
}

function show_script(script: Script) {
    document.title = `${script.name} · Cascade`;
    element("name").textContent = script.name.split("/").pop()!;
    if (!is_text_open && !editor.is_changing) {
        editor.text = script.text;
        if (replaced_script === undefined) element("text").ariaBusy = "false";
        show_messages(script.messages);
    }
    lesson.script = script.text;
    show_sliders(script.controls, change);
    measure.species = script.species;
    if (brush.offer(script.brushes)) {
        element("names").replaceChildren(...script.species.map((name) => new Option(name)));
    }
}

function choose_palette() {
    pattern.palette = palettes.find(({ name }) => name === palette_choice.value) ?? palettes[0];
    if (pattern.palette) look.show_palette(pattern.palette);
    pattern.draw();
}

function show_state(snapshot: Snapshot) {
    const { stages } = snapshot;
    if (replaced_script !== undefined && replaced_script !== snapshot.script) {
        replaced_script = undefined;
        element("text").ariaBusy = "false";
    }
    element("view").dataset.script = String(snapshot.script);
    strip.show(snapshot);
    progress.show(snapshot);
    const { is_going_on } = pace;
    button("run").toggleAttribute("data-going", is_going_on);
    button("run").ariaLabel = is_going_on ? "Pause" : "Run";
    const is_over = stages.every((stage) => stage.has_ended);
    button("run").disabled = !pace.is_possible;
    button("step").disabled = is_over && !is_going_on;
    button("next").disabled = snapshot.stage === stages.length;
    button("undo").disabled = !snapshot.can_undo;
    button("redo").disabled = !snapshot.can_redo;
    failure.show(snapshot);
    if (is_over && snapshot.remarks.length > 0 && performance.now() > noticed_until) notice(snapshot.remarks.at(-1)!);
}

function start_run() {
    void pace.start();
    if (pattern.snapshot) show_state(pattern.snapshot);
}

function go_back(what: "undo" | "redo") {
    pace.forget();
    is_text_open = false;
    void ask(what);
}

const name_of_file = () => element("name").textContent!.replace(/\.cascade$/, "") || "pattern";
const save = (ending: string, text: string) => download(`${name_of_file()}.${ending}`, new Blob([text], { type: "text/plain" }));

const saver = new ModelSaver(pattern, ask, (words) => notice(words, false, words ? 60 : 0));
const save_model = (what: "model" | "maps") => saver.save(what, name_of_file(), { show: shown.value, palette: palette_choice.value });

const actions: Record<string, () => void> = {
    // Does what the label of the button says, because the run may just have ended.
    run: () => void (button("run").hasAttribute("data-going") ? pace.stop() : start_run()),
    step: () => void ask("step", { count: 1 }),
    restart: () => void ask("restart"),
    undo: () => go_back("undo"),
    redo: () => go_back("redo"),
    next: () => void ask("next_stage"),
    systems: () => library.open(),
    load: () => element("model_file").click(),
    fit: () => view().fit(),
    flat: () => {
        pattern.is_laid_flat = !pattern.is_laid_flat;
        button("flat").ariaPressed = String(pattern.is_laid_flat);
        pattern.draw();
    },
    hold: () => look.toggle_hold(),
    measure: () => measure.toggle(),
    point: () => points.toggle(),
    pick: () => measure.wait_for_pick(),
    nearer: () => view().scale(1.5),
    farther: () => view().scale(1 / 1.5),
    slice_before: () => slices.move(-1),
    slice_after: () => slices.move(1),
    help: () => help.open(),
    log: async () => {
        const { text } = await connection.ask<{ text?: string }>("log");
        if (text !== undefined) save("session", text);
    },
    picture: async () => {
        const { png } = await ask<{ png?: string }>("picture", { show: shown.value, palette: palette_choice.value, ...picture_fields(pattern) });
        if (png) download(`${name_of_file()}.png`, new Blob([Uint8Array.from(atob(png), (sign) => sign.charCodeAt(0))], { type: "image/png" }));
    },
    model: () => void save_model("model"),
    maps: () => void save_model("maps"),
    script: () => save("cascade", editor.text),
    link: () => void link.open(editor.text),
    movie: () => recording.toggle_movie(),
    frames: () => {
        void recording.toggle_frames();
        // Draws the present moment as the first frame.
        pattern.draw();
        if (!pattern.canvas.hidden) keep_what_is_seen();
    },
};
for (const [id, act] of Object.entries(actions)) document.querySelector(`button#${id}`)?.addEventListener("click", act);
element("help_button").addEventListener("click", actions.help);

async function load_model(file?: File) {
    if (!file) return;
    const name = await send_model(file, ask, (sent) => notice(`loading ${file.name} … ${Math.floor(100 * sent)} %`, false, 60));
    if (!name) return;
    notice("");
    const { from, to, text } = with_model(editor.text, name);
    editor.replace(from, to, text);
}
const model_file = element<HTMLInputElement>("model_file");
model_file.addEventListener("change", () => {
    void load_model(model_file.files?.[0]);
    model_file.value = "";
});
button("load").hidden = EngineLine.is_carried;
take_drops(load_model);
obey_keys(actions);
close_popups(["look", "save"]);

palette_choice.addEventListener("change", () => {
    localStorage.setItem("palette", palette_choice.value);
    choose_palette();
});

const shown = element<HTMLInputElement>("show");
shown.addEventListener("change", async () => {
    const answer = await ask("show", { expression: shown.value });
    shown.classList.toggle("wrong", !answer.is_done);
    if (answer.is_done) pattern.time.clear();
});

const points = new Points(pattern, editor, (why) => notice(why, false, 5));
const plane = new PlaneView(pattern.canvas, () => pattern.columns);
const view = () => pattern.is_solid ? solid : plane;
plane.moved = () => {
    pattern.redraw();
    show_marks();
};
solid.moved = show_marks;
const brush = new Brush(pattern, points, measure, change, () => view().zoom);
for (const [canvas, seen] of [[pattern.canvas, plane], [solid.canvas, solid]] as const) new Gestures(canvas, seen, (event, is_first) => brush.press(event, is_first));
