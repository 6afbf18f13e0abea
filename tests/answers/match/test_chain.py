from evenbreak.answers.match.chain import chain_answer
from evenbreak.chains import chain_of, stochastic_limit

ONE_BALL = chain_of(
    [("S1", "W", 0.3), ("S1", "S2", 0.7), ("S2", "L", 0.2), ("S2", "S1", 0.8)], start="S1"
)
ROUND = chain_of([("A", "B", 1.0), ("B", "A", 1.0)], start="A")


def test_files_hold_the_limit_or_the_density():
    limit = chain_answer(ONE_BALL).to_frame()
    assert limit["probability"].tolist() == stochastic_limit(ONE_BALL).probability.tolist()
    after = chain_answer(ONE_BALL, steps=1).to_frame()
    assert dict(after.to_numpy().tolist()) == {"S1": 0.0, "W": 0.3, "S2": 0.7, "L": 0.0}


def test_where_it_ends_likeliest_first():
    words = chain_answer(ONE_BALL).sentences[0]
    assert words.index("'W' (0.6818)") < words.index("'L' (0.3182)")
    assert "3.86 steps" in words


def test_a_chain_that_goes_round_has_a_period():
    answer = chain_answer(ROUND)
    assert answer.to_dict()["period"] == 2
    assert answer.to_dict()["mean_steps"] is None
    assert "period 2" in answer.sentences[0]


def test_of_many_states_some_are_named():
    many = chain_of([("go", f"end {k}", 0.1) for k in range(10)], start="go")
    assert chain_answer(many).sentences[0].count("'end ") == 5
    assert "5 other states" in chain_answer(many).sentences[0]


def test_what_could_not_be_worked_out_is_a_warning():
    rare = chain_of(
        [("A", "B", 1e-300), ("A", "A", 1.0), ("B", "C", 1e-300), ("B", "A", 1.0)], start="A"
    )
    answer = chain_answer(rare, warnings=["the file is old"])
    assert answer.warnings[0] == "the file is old"
    assert len(answer.warnings) == 2
