# SPDX-License-Identifier: BSD-3-Clause
"""Strings that were valid before someone's editor, disk or cat got at them, for hypothesis."""

from hypothesis import strategies as st

_PIECES = st.one_of(
    st.text(max_size=8),
    st.sampled_from(
        ["\0", "\ufeff", "\r\n", "---", "#", "=", "[", "]", "<=", "9" * 400, "1e39", "1e400", "nan", "-0x", "\ud800"]
    ),
)


@st.composite
def damaged(draw: st.DrawFn, originals: list[str]) -> str:
    """Return one of the strings with up to four parts replaced, left out or repeated."""
    text = draw(st.sampled_from(originals))
    for _ in range(draw(st.integers(1, 4))):
        begin = draw(st.integers(0, len(text)))
        end = draw(st.integers(begin, min(len(text), begin + 20)))
        middle = draw(st.one_of(_PIECES, st.just(text[begin:end] * 2)))
        text = text[:begin] + middle + text[end:]
    return text
