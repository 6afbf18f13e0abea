"""The color is readable by day and by night, and a logo is a picture of moderate size."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.site.look import CONTRAST, DARK, LIGHT, MOST_LOGO_BYTES, accent, contrast, logo_name


@given(st.integers(0, 0xFFFFFF))
def test_any_color_is_readable_and_so_is_what_is_written_on_it(number: int) -> None:
    made = accent(f"#{number:06x}")
    assert min(contrast(made.light, one) for one in LIGHT) >= CONTRAST
    assert min(contrast(made.dark, one) for one in DARK) >= CONTRAST
    assert contrast(made.on_light, made.light) >= CONTRAST
    assert contrast(made.on_dark, made.dark) >= CONTRAST


def test_the_contrast_is_that_of_the_standard() -> None:
    """The examples of WCAG's understanding document and of its well-known checker."""
    assert contrast("#767676", "#ffffff") == pytest.approx(4.54, abs=0.005)
    assert contrast("#0000ff", "#ffffff") == pytest.approx(8.59, abs=0.005)


def test_a_dark_enough_color_stays_as_it_is() -> None:
    assert accent("#1B6E53")[:1] == ("#1b6e53",)
    assert not accent("#1b6e53").changed
    assert accent("#FFEE00").changed


@pytest.mark.parametrize("color", ["red", "#12", "1b6e53", "#1b6e5g", "#1b6e53;}body{display:none"])
def test_what_is_no_color_is_refused_with_a_remedy(color: str) -> None:
    with pytest.raises(InputError, match="write one such as"):
        accent(color)


def test_a_logo_is_known_by_its_content() -> None:
    assert logo_name(b"\xff\xd8\xff\xe0", "club.png") == "logo.jpg"
    assert logo_name(b"RIFF1234WEBPVP8 ", "club") == "logo.webp"
    for wrong in (b"<svg onload=alert(1)>", b"RIFF1234WAVE", b""):
        with pytest.raises(InputError, match="save it as one"):
            logo_name(wrong, "club.png")
    with pytest.raises(InputError, match="save it smaller"):
        logo_name(b"\x89PNG\r\n\x1a\n" + bytes(MOST_LOGO_BYTES), "club.png")
