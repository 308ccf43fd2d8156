// The search page: shows the parts of the site that contain all words of the query. `parts` is in search_index.js.
"use strict";

const query = document.getElementById("query");
const most_shown = 40;

/// A part with all words: the more of them are in its heading, the better. 0 if a word is missing.
function weight(words, [, , title, heading, text]) {
    const [low_title, low_heading, low_text] = [title, heading, text].map((words) => words.toLowerCase());
    let sum = 0;
    for (const word of words) {
        const found = (low_heading.includes(word) ? 8 : 0) + (low_title.includes(word) ? 4 : 0) + Math.min(low_text.split(word).length - 1, 3);
        if (found === 0) return 0;
        sum += found;
    }
    return sum;
}

/// The text around the first of the words.
function excerpt(words, text) {
    const places = words.map((word) => text.toLowerCase().indexOf(word)).filter((place) => place >= 0);
    const near = Math.min(...places, text.length) - 60, from = near <= 0 ? 0 : text.indexOf(" ", near) + 1;
    return (from > 0 ? "… " : "") + text.slice(from, from + 200) + (from + 200 < text.length ? " …" : "");
}

function entry(words, [page, id, title, heading, text]) {
    const item = document.createElement("li"), link = document.createElement("a"), place = document.createElement("div");
    link.href = `${page}#${id}`;
    link.textContent = heading === title ? title : `${title}: ${heading}`;
    place.textContent = excerpt(words, text);
    item.append(link, place);
    return item;
}

function search() {
    const words = query.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    const found = words.length === 0 ? [] : parts.map((part) => [weight(words, part), part]).filter(([points]) => points > 0);
    found.sort(([a], [b]) => b - a);
    document.getElementById("found").replaceChildren(...found.slice(0, most_shown).map(([, part]) => entry(words, part)));
    const count = found.length === 1 ? "1 place" : `${found.length} places`;
    document.getElementById("count").textContent = words.length === 0 ? "" : found.length > most_shown ? `${count}, the first ${most_shown} of them:` : count;
}

query.value = new URLSearchParams(location.search).get("q") ?? "";
query.addEventListener("input", search);
search();
