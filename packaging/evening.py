"""Play an evening on a page as a browser does, by its forms alone; only the standard library.

    python packaging/evening.py WORDS...     the words that start the program, such as ./evenbreak

It starts the program as a double click does, with a home folder of its own, and reads off what it
prints where the page is and the PIN. 16 players are pasted, drawn, and play double elimination; one
result is corrected, one is undone; phones are let in and shut out; the night is taken home. It ends
with exit code 0 if all of that went as it should.
"""

import http.cookiejar
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.parse
import urllib.request
from html.parser import HTMLParser

PLAYERS = [f"Player {k},{700 - 15 * k}" for k in range(1, 17)]


class Forms(HTMLParser):
    """The posted forms of a page, as a browser would send them with nothing chosen."""

    def __init__(self, text):
        super().__init__()
        self.forms, self.name = [], None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        at = {name: value or "" for name, value in attrs}
        if tag == "form":
            self.forms.append((at.get("action", ""), {}, {}))
        if not self.forms:
            return
        _, fields, choices = self.forms[-1]
        name, value = at.get("name"), at.get("value", "")
        kind = at.get("type", "submit" if tag == "button" else "text")
        if tag == "select":
            self.name = name
        elif tag == "option" and (self.name not in fields or "selected" in at):
            fields[self.name] = value
        elif name and kind in ("radio", "submit", "checkbox"):
            choices.setdefault(name, []).append(value)
            if "checked" in at:
                fields[name] = value
        elif name and tag in ("input", "textarea") and kind != "file":
            fields[name] = value


class Browser:
    """A browser with its cookies, on one page."""

    def __init__(self, address):
        self.address, self.text = address, ""
        jar = http.cookiejar.CookieJar()
        self.opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(jar))

    def open(self, path, fields=None):
        body = None if fields is None else urllib.parse.urlencode(fields).encode()
        with self.opener.open(self.address + path, body, timeout=60) as got:
            self.content = got.read()
        self.text = self.content.decode("utf-8", "replace")
        return self.text

    def forms(self, action, **having):
        """Return the forms that go there, with these values in them."""
        return [
            (fields, choices)
            for to, fields, choices in Forms(self.text).forms
            if to == action and having.items() <= fields.items()
        ]

    def send(self, action, having=(), **filled):
        """Send the first form that goes there."""
        fields, _ = self.forms(action, **dict(having))[0]
        return self.open(action, {**fields, **filled})


def play(address, pin, luck):
    """Play the evening."""
    desk = Browser(address)
    desk.open("/pin")
    desk.send("/pin", pin=pin)
    desk.open("/new")
    desk.send("/new", entrants="\n".join(PLAYERS), name="Bundle night", format="double", race="3")
    desk.open("/desk")
    desk.send("/desk/draw")
    entered = undone = corrected = 0
    while True:
        desk.open("/desk")
        if calls := desk.forms("/desk/call"):
            desk.open("/desk/call", calls[0][0])
            continue
        results = [one for one in desk.forms("/desk/result") if "winner" in one[1]]
        if not results:
            break
        fields, choices = luck.choice(results)
        games = choices.get("games", ["0"])
        winner = luck.choice(choices["winner"])
        desk.open("/desk/result", {**fields, "winner": winner, "games": games[0]})
        entered += 1
        if entered == 5 and not undone:
            desk.send("/desk/undo")
            entered, undone = entered - 1, 1
        if entered == 12 and not corrected:
            number = 1
            while not desk.forms("/desk/correct"):
                desk.open(f"/desk?match={number}")
                number += 1
            fields, choices = desk.forms("/desk/correct")[0]
            for winner in choices["winner"]:  # one of the two is another result than it was
                asked = desk.open("/desk/correct", {**fields, "winner": winner, "games": "1"})
                if 'name="sure"' in asked:
                    fields, choices = desk.forms("/desk/correct", sure="yes")[0]
                    desk.open("/desk/correct", {**fields, "follow": choices["follow"][-1]})
            corrected = 1
    print(f"{entered} results, {undone} undone, {corrected} corrected")
    assert entered >= 30
    take_home(desk, entered)
    let_phones_in(desk)


def take_home(desk, entered):
    """Look at the end of the night, and at what can be taken home of it."""
    for _ in range(120):  # places come with the odds
        if "Champion" in desk.open("/share"):
            break
        time.sleep(0.5)
    assert "Champion" in desk.text
    assert "<!doctype html>" in desk.open("/share.html").lower()[:99]
    desk.open("/share.png")
    assert desk.content.startswith(b"\x89PNG"), "no picture"
    desk.open("/bracket.pdf")
    assert desk.content.startswith(b"%PDF"), "no PDF"
    assert desk.open("/share.csv").count("\n") > entered - 1
    desk.open("/desk/history")
    assert "Undo" in desk.text
    for path in ("openapi.json", "tonight", "tonight/bracket", "tonight/finish"):
        assert isinstance(json.loads(desk.open(f"/api/v1/{path}")), dict), path
    for path in (
        "overlay/1",
        "overlay/bracket",
        "",
        "bracket",
        "players",
        "screen",
        "prizes",
        "desk/codes",
        "evenbreak.css",
    ):
        desk.open(f"/{path}")


def let_phones_in(desk):
    """Let phones in, ask as one, and shut them out."""
    desk.open("/desk/phones")
    desk.send("/desk/phones", open="yes")
    desk.opener.addheaders = [("Accept-Language", "de")]
    assert "Handys" in desk.open("/desk/phones"), "no catalog of German"
    where = re.findall(r"class=\"to\">([^<]+)</figcaption>", desk.text)
    for one in where:
        Browser(f"http://{one}").open("/me")
    desk.send("/desk/phones", open="")
    print(f"phones were let in at {', '.join(where)} and shut out again")


def main():
    """Start the program, play, and end it."""
    with tempfile.TemporaryDirectory() as home:
        own = {"HOME": home, "USERPROFILE": home, "BROWSER": "true", "PYTHONUNBUFFERED": "1"}
        begun = time.monotonic()
        program = subprocess.Popen(
            sys.argv[1:], stderr=subprocess.PIPE, text=True, env={**os.environ, **own}
        )
        try:
            said = ""
            while "Ctrl+C" not in said:
                line = program.stderr.readline()
                assert line, f"it ended: {said}"
                said += line
            print(f"{said}-- after {time.monotonic() - begun:.1f} s")
            (address,), (pin,) = re.findall(r"page: (\S+)", said), re.findall(r"PIN: (\d+)", said)
            for _ in range(100):
                try:
                    Browser(address).open("/")
                    break
                except OSError:
                    time.sleep(0.1)
            print(f"the first page after {time.monotonic() - begun:.1f} s")
            play(address, pin, random.Random(7))
        finally:
            program.terminate() if os.name == "nt" else program.send_signal(signal.SIGINT)
            program.wait(20)
    print("The evening ran as it should.")


if __name__ == "__main__":
    main()
