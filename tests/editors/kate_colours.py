"""kate_colours.py PAGE: the classes of the characters in a page of kate-syntax-highlighter (its light theme)."""
import html.parser
import sys

from runs import print_runs

CLASSES = {
    "#607880": "doc",
    "#898887": "comment",
    "#bf0303": "string",
    "#b08000": "number",
    "#0057ae": "setting",
    "#644a9b": "function",
    "#006e28": "word",
    "#aa5500": "value",
}


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.text, self.classes, self.style, self.is_script = "", [], "", False

    def handle_starttag(self, tag, attributes):
        self.is_script = self.is_script or tag == "pre"
        self.style = dict(attributes).get("style", "") if tag == "span" else ""

    def handle_endtag(self, tag):
        self.is_script = self.is_script and tag != "pre"
        self.style = ""

    def handle_data(self, data):
        if not self.is_script:
            return
        colour = self.style.partition("color:")[2][:7]
        found = CLASSES.get(colour, "keyword" if "bold" in self.style else "")
        for character in data:
            is_quoted = found in ("doc", "comment", "string")
            self.classes.append(found if is_quoted or not character.isspace() else "")
        self.text += data


page = Page()
page.feed(open(sys.argv[1], encoding="utf-8").read())
print_runs(page.text.removeprefix("\n"), page.classes[page.text.startswith("\n"):])
