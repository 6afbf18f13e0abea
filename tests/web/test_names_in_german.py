"""A German evening of players whose names look like our own words: nobody is renamed."""

from pathlib import Path

from evenbreak.files.store.tournament import read_tournament
from web.phones import Phone, answering

NAMES = [
    *("Tom and Jerry", "W1.1/Final", "Bo beat Ann 7:5", "winner of W1.1", "Jr. Smith", "Al in F"),
    *("Player and Son", "the Shark"),
]
WRONG = ["Tom und Jerry", "W1.1/Finale", "Bo schlägt Ann", "Sieger von W1.1,", "Player und Son"]


def test_nobody_is_renamed_on_a_german_page(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True, language="de")
        heard: list[str] = []

        def send(path: str, **fields: object) -> str:
            shown = director.send(path, **fields)
            heard.append(shown.words)
            return shown.words

        plan = {"format": "single", "races": "even", "race": 3, "tables": 2, "seeding": "listed"}
        asked = plan | {"discipline": "9-ball", "scale": "fargo"}
        entrants = "\n".join(
            ["player,rating", *(f"{name},{600 - k}" for k, name in enumerate(NAMES))]
        )
        send("/new", entrants=entrants, **asked)
        send("/desk/draw")
        while read_tournament(site.path).standing.to_play:
            state = read_tournament(site.path)
            match = state.standing.to_play[0]
            first, second = state.pair(match)
            said = send("/desk/result", match=match, a=3, b=1)
            assert f"{first} schlägt {second} 3:1" in said
            assert f"{first} schlägt" in send("/desk/result", match=match, a=3, b=1)
            if match == "W1.1":
                assert "Distanz im Finale" in director.open("/desk/more").words
                ends = director.open("/desk/time").words
                assert "Mit einem Tisch mehr" in ends
                assert "100 %" in ends
                assert not [one for one in ("Races", "With", "\\x") if one in ends]
        assert "Tom and Jerry" in send("/desk/late", player="Tom and Jerry", rating=500)
        pages = ("/", "/screen", "/players", "/bracket", "/desk/history")
        heard.extend(director.open(page).words for page in pages)
        for words in heard:
            assert not [one for one in WRONG if one in words], words
        assert all(any(name in words for words in heard) for name in NAMES)


def test_no_team_is_renamed_on_a_german_page(tmp_path: Path) -> None:
    teams = ("winner of W1.1", "the Shark")
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True, language="de")
        plan = {"race": 3, "races": "even", "order": "alternate", "scale": "fargo", "count": "sets"}
        ours, theirs = "Tom and Jerry,612\nPlayer and Son,590", "draw,600\nFinal,580"
        asked = {"team_a": teams[0], "team_b": teams[1], "players_a": ours, "players_b": theirs}
        director.send("/team/new", **plan, **asked)
        put = {"by": "director", "team": 0, "number": 1, "pick": "0", "night": 1}
        shown = director.send("/team/put", **put)
        assert "Tom and Jerry spielt Satz 1" in shown.words
        heard = [director.open(page).words for page in ("/team", "/team/history")]
        for words in heard:
            assert all(team in words for team in teams)
            assert not [
                one for one in ("Tom und Jerry", "Sieger von", "Player und") if one in words
            ]
        assert "winner of W1.1 stellt in Satz 1 auf: Tom and Jerry" in heard[1]
