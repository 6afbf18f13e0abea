"""The tables of the page: what stands where."""

from evenbreak.source_text.answers import section_5_findings
from evenbreak.source_text.reproduce import section_5_tables
from evenbreak.source_text.section5 import page_tables

ROWS = section_5_tables()


def lines(text):
    return text.splitlines()


def test_computed_numbers_have_the_printed_one_beside_them_where_they_differ():
    shown = page_tables.TABLES[2](ROWS["table_5_2"])
    assert "| 0.96 | 24.0 | 16.0 (text: 15.9) | 16 | 0.667 |" in lines(shown)
    shown = page_tables.TABLES[4](ROWS["table_5_4"])
    assert "| 10 | 0.95 | 0.94 | 0.545 (text: 0.54) | 0.503 | 0.505 |" in lines(shown)


def test_small_chances_keep_a_digit():
    shown = page_tables.score_table(ROWS["problem_5_06_scores_p_2_3"])
    assert lines(shown)[0] == "| m \\ n | 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 | 9 |"
    assert "| **0** | 1.000 | 0.333 | 0.111 | 0.037 | 0.012 | 0.004 | 0.001 | 5E-4 |" in shown


def test_table_5_3_has_three_rows_for_each_chance():
    shown = lines(page_tables.TABLES[3](ROWS["table_5_3"]))
    assert len(shown) == 2 + 3 * 5
    assert shown[2].startswith("| 0.5 | mode | 0 | 0 |")


def test_charts_stand_side_by_side_and_short_ones_leave_cells_empty():
    shown = lines(page_tables.TABLES[6](ROWS["table_5_6"]))
    assert shown[2] == "| 0–6 | 4:4 | 0–5 | 5:5 | 0–4 | 6:6 | 0–2 | 10:10 |"
    assert shown[-1].startswith("|  |  |  |  |  |  |")


def test_steps_products_and_seven_shots():
    steps = lines(page_tables.steps_table(ROWS["problem_5_23"]))
    assert "| from S1: limit | 0.4545 | 0.0000 | 0.0000 | 0.5455 |" in steps
    products = lines(page_tables.products_table(section_5_findings()))
    assert products[2] == "| **1** | 1 | 1.5 | 2.5 | 3 |"
    shots = lines(page_tables.table_5_22(section_5_findings()))
    assert len(shots) == 2 + 7
    assert shots[4].startswith("| p1=0.9 p2=0.9 | 0.9091 | 0.90 |")


def test_triangle_games_ladder_and_eigenvalues():
    assert "| **4** | 1 | 4 | 6 | 4 | 1 |" in page_tables.triangle_table()
    games = lines(page_tables.games_table(ROWS["problem_5_09"]))
    assert "| N=120 p=0.52 | 61.92 | 62 | 1 | 62.4 | 5.47284 |" in games
    ladder = lines(page_tables.ladder_table(ROWS["npl_ladder"]))
    assert ladder[-1] == "| 20 | 2 points | 3.668 | 3.697 |"
    assert page_tables.eigenvalues(ROWS["problem_5_23"]).endswith("0.3464, −0.3464")
    assert page_tables.matrix_table("M, winner breaks", ROWS).endswith("| **S2** | q1 | p2 |")
