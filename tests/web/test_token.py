# SPDX-License-Identifier: BSD-3-Clause
"""The token of the page, in a real browser."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Error, Page

from page_client import Server
from ros_support import stop, wait_until
from web_support import TIMEOUT, new_page

NEEDS_TOKEN = "This address needs a token: open the whole address that the simulator has printed"


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Server]:
    with Server(tmp_path) as running:
        yield running


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    opened = new_page(browser, 1000, 620)
    yield opened
    opened.context.close()


def is_connected(page: Page) -> bool:
    try:
        return bool(page.evaluate("Boolean(window.bubblesim?.link.connected)"))
    except Error:  # the page is being loaded again
        return False


def wait_for_connection(page: Page) -> None:
    wait_until(lambda: is_connected(page), "the connection", timeout=TIMEOUT / 1000)


def test_a_page_without_the_token_states_what_it_needs(server: Server, page: Page) -> None:
    for address in (f"{server.origin}/", f"{server.origin}/#token=wrong", f"{server.origin}/?token=t"):
        page.goto("about:blank")
        page.goto(address)
        page.locator(".lost", has_text=NEEDS_TOKEN).wait_for()
        page.wait_for_timeout(1500)  # it does not try again
        assert page.locator(".lost").inner_text() == NEEDS_TOKEN
        assert not is_connected(page)


def test_the_token_stays_with_the_tab_and_leaves_the_address_line(server: Server, page: Page) -> None:
    page.goto(server.address)
    wait_for_connection(page)
    assert page.url == f"{server.origin}/"
    assert page.context.cookies() == []
    page.reload()
    wait_for_connection(page)
    second = page.context.new_page()
    second.goto(server.address)
    wait_for_connection(second)
    third = page.context.new_page()
    third.goto(server.origin)
    third.locator(".lost", has_text=NEEDS_TOKEN).wait_for()


def test_a_new_token_is_taken_in_the_same_tab(server: Server, page: Page) -> None:
    page.goto(f"{server.origin}/#token=old")
    page.locator(".lost", has_text=NEEDS_TOKEN).wait_for()
    page.goto(server.address)
    wait_for_connection(page)


def test_the_file_with_the_address_opens_the_window(server: Server, page: Page) -> None:
    page.goto(server.address_file.as_uri())
    page.wait_for_url(f"{server.origin}/")
    wait_for_connection(page)


def test_a_server_with_another_token_is_not_asked_again(server: Server, page: Page) -> None:
    page.goto(server.address)
    wait_for_connection(page)
    stop(server.process)
    wait_until(lambda: not is_connected(page), "the end of the connection")
    assert page.locator(".lost").inner_text() == "No connection to the server"
