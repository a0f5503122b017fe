# SPDX-License-Identifier: BSD-3-Clause
"""Playing recorded runs back, and videos, in a real browser."""

import base64
import gzip
from collections.abc import Callable
from pathlib import Path

import cbor2
import numpy as np
import pytest
from playwright.sync_api import Browser

from web_support import Node, Window

Show = Callable[..., Window]

PLACE = "bubblesim.view.poseOf(bubblesim.scene.byPath('/Ball'))"
RUN = "bubblesim.recorder.usable[0]"
AT_A_PICTURE = """new Promise((done) => {
  const end = bubblesim.playback.on("changed", () => { end(); done([bubblesim.playback.time, performance.now()]); });
})"""


def after(page: Window, seconds: float) -> None:
    """Wait until the recorded run is so long, and pause it."""
    page.wait(f"{RUN} && {RUN}.end - {RUN}.begin > {seconds}")
    page.call("window.pause")
    page.wait("bubblesim.link.frame.state === 'paused'")


def seek(page: Window, time: float) -> None:
    page.js("bubblesim.playback.seek(x)", time)


def test_a_playback_shows_where_bodies_were(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        handle = page.js("bubblesim.scene.byPath('/Ball').handle")
        truth = {}
        for _ in range(20):
            time = page.js("bubblesim.link.frame.time")
            page.page.keyboard.press("n")
            page.wait("bubblesim.link.frame.time > x", time)
            truth[page.js("bubblesim.link.frame.time")] = page.call("window.get_state", handle)["pose"][:3]
        now = page.js(PLACE)
        page.page.keyboard.press("l")
        page.wait("!document.querySelector('.playback').hidden")
        for time, place in truth.items():
            seek(page, time)
            assert page.js(PLACE)[:3] == pytest.approx(place, abs=1e-5)
        (first, a), (second, b) = list(truth.items())[9:11]
        seek(page, (first + second) / 2)
        assert page.js(PLACE)[:3] == pytest.approx(np.mean([a, b], axis=0), abs=1e-5)
        page.page.click("button:has-text('Back to live')")
        page.wait("document.querySelector('.playback').hidden")
        page.js("bubblesim.view.settled()")
        assert page.js(PLACE) == pytest.approx(now, abs=1e-6)


def test_a_run_can_be_played_after_the_simulation_was_stopped(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.button("Play (Space)").click()
        page.wait("bubblesim.link.frame.time > 1")
        page.button("Stop").click()
        page.wait("bubblesim.link.frame.state === 'stopped' && bubblesim.link.frame.time === 0")
        page.js("bubblesim.view.settled()")
        start = page.js(PLACE)
        page.button("Replay the last run").click()
        assert page.js("bubblesim.playback.time") > 1
        assert page.js(PLACE)[2] < start[2] - 0.1
        seek(page, 0)
        assert page.js(PLACE) == pytest.approx(start, abs=1e-6)


def test_a_playback_shows_what_it_is_and_changes_nothing(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        after(page, 1)
        page.page.keyboard.press("l")
        assert page.page.locator(".toolbar .state").inner_text() == "playback"
        for title in ("Play (Space)", "Stop", "One step (N)"):
            assert page.button(title).is_disabled()
        page.select("/Ball")
        page.page.keyboard.press("Delete")
        page.page.keyboard.press("n")
        page.page.wait_for_selector(".notice:has-text('This is a playback')")
        before = page.js("bubblesim.link.frame.time")
        page.page.keyboard.press("l")
        assert page.page.locator(".toolbar .state").inner_text() == "paused"
        assert page.js("bubblesim.link.frame.time") == before
        assert page.js("bubblesim.scene.byPath('/Ball') !== undefined")


def test_keys_play_pause_and_step_through_frames_while_the_camera_is_free(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        after(page, 1.5)
        keys = page.page.keyboard
        keys.press("l")
        end = page.js("bubblesim.playback.time")
        keys.press("ArrowLeft")
        assert page.js("bubblesim.playback.time") == page.js(f"{RUN}.frames.at(-2).time")
        keys.press("ArrowRight")
        assert page.js("bubblesim.playback.time") == end
        page.page.locator(".playback select[title^='Seconds']").select_option("0.1")  # it takes 15 s or more
        keys.press("Space")  # from the begin: it was at the end
        time, now = page.js(AT_A_PICTURE)
        page.wait(f"bubblesim.playback.time > {time + 0.15}")
        later, then = page.js(AT_A_PICTURE)
        assert later - time == pytest.approx(0.1 * (then - now) / 1000, abs=0.05)  # a busy browser draws seldom
        camera = page.js("bubblesim.view.camera.position.toArray()")
        page.look_from_above()
        assert page.js("bubblesim.view.camera.position.toArray()") != camera
        keys.press("Space")
        assert not page.js("bubblesim.playback.plays")


def test_plots_show_the_time_of_the_playback(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        page.js("bubblesim.layout.show('plots')")
        page.js("bubblesim.plot('pose', ['/Ball', '0']).then(() => 0)")
        after(page, 2)
        page.page.keyboard.press("l")
        page.js("bubblesim.plot('pose', ['/Ball', '2']).then(() => 0)")  # has the whole run, too
        for part in (0.25, 0.75):
            frames = f"{RUN}.frames"
            seek(page, page.js(f"{frames}[Math.floor(x * {frames}.length)].time", part))
            place = page.js(PLACE)
            for plot, axis in ((0, 0), (1, 2)):
                value = f"parseFloat(document.querySelectorAll('.plot')[{plot}].querySelector('.now').textContent)"
                page.wait(f"Math.abs({value} - x) < 1e-3 * Math.max(1, Math.abs(x))", place[axis])  # of four digits
        page.page.keyboard.press("l")
        last = page.js(PLACE)[0]
        page.wait("Math.abs(parseFloat(document.querySelector('.plot .now').textContent) - x) < 0.01", last)


def test_a_playback_has_models_that_are_gone_now_and_not_those_that_came_later(tmp_path: Path, show: Show) -> None:
    shown = """((handle) => {
      const [part] = bubblesim.view.bodies.partsOf(handle);
      return Boolean(part) && Math.abs(bubblesim.view.bodies.matrices.get(handle).determinant()) > 0.5;
    })(x)"""
    with Node(tmp_path, "tricycle") as node:
        page = show(node)
        page.wait("bubblesim.link.frame.time > 0.3")
        gone = page.call("window.add_model", "chair", [3, 0, 0])
        page.wait("bubblesim.scene.objects.has(x)", gone)
        link = page.js("bubblesim.scene.objects.get(x).children.find((e) => e.kind === 'link').handle", gone)
        time = page.js("bubblesim.link.frame.time")
        page.wait("bubblesim.link.frame.time > x + 0.3", time)
        page.call("window.remove", gone)
        page.wait("!bubblesim.scene.objects.has(x)", gone)
        after(page, time + 1)
        page.page.keyboard.press("l")
        page.js("bubblesim.view.settled()")
        assert not page.js(shown, link)
        seek(page, time + 0.2)
        page.js("bubblesim.view.settled()")
        assert page.js(shown, link)
        seek(page, 0.1)
        page.js("bubblesim.view.settled()")
        assert not page.js(shown, link)
        page.page.keyboard.press("l")
        page.js("bubblesim.view.settled()")
        assert not page.js("bubblesim.view.bodies.partsOf(x).length", link)


def saved_run(page: Window, folder: Path) -> Path:
    """Save the run that is played back."""
    with page.page.expect_download() as download:
        page.page.click("button:has-text('Save run')")
    file = folder / download.value.suggested_filename
    download.value.save_as(file)
    return file


def test_a_saved_run_is_played_in_another_session(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        after(page, 1)
        page.page.keyboard.press("l")
        seek(page, 0.7)
        place = page.js(PLACE)
        file = saved_run(page, tmp_path)
        assert file.suffix == ".run"
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        page.open_file(file)
        page.wait("bubblesim.playback.run !== null")
        seek(page, 0.7)
        assert page.js(PLACE) == pytest.approx(place, abs=1e-6)
        assert file.name in page.page.locator(".playback select").first.inner_text()


def test_a_run_is_dropped_on_the_window(tmp_path: Path, show: Show) -> None:
    drop = """(async () => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(atob(x), (c) => c.charCodeAt(0))], "dropped.run"));
      const send = (kind) => document.querySelector(".view canvas").dispatchEvent(
        new DragEvent(kind, { dataTransfer: transfer, bubbles: true, cancelable: true }));
      send("dragover");
      const seen = !document.querySelector(".dropzone").hidden;
      send("drop");
      return seen;
    })()"""
    with Node(tmp_path, "ball") as node:
        page = show(node)
        after(page, 0.5)
        page.page.keyboard.press("l")
        file = saved_run(page, tmp_path)
        page.page.keyboard.press("l")
        assert page.js(drop, base64.b64encode(file.read_bytes()).decode())
        page.wait("bubblesim.playback.run?.name === 'dropped.run'")
        assert page.js("document.querySelector('.dropzone').hidden")


def test_files_that_are_no_runs_of_this_scene_are_refused(tmp_path: Path, show: Show) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        after(page, 0.5)
        page.page.keyboard.press("l")
        whole = saved_run(page, tmp_path).read_bytes()
        page.page.keyboard.press("l")
        content = cbor2.loads(gzip.decompress(whole))
        other = {
            **content,
            "scene": "maze",
            "layouts": [[n, [["/Maze/wall", 0]], [], []] for n, *_ in content["layouts"]],
        }
        short = {**content, "frames": [[*frame[:2], frame[2][:8], frame[3]] for frame in content["frames"]]}
        back = {**content, "frames": content["frames"][::-1]}
        bad = {
            "cut off": whole[: len(whole) // 2],
            "not a recording of this window": b"hello",
            "open that scene first": gzip.compress(cbor2.dumps(other)),
            "too few poses": gzip.compress(cbor2.dumps(short)),
            "comes after one at": gzip.compress(cbor2.dumps(back)),
            "its version is 2": gzip.compress(cbor2.dumps({**content, "version": 2})),
            "is not a recording": gzip.compress(cbor2.dumps([1, 2])),
        }
        for number, (message, content) in enumerate(bad.items()):
            file = tmp_path / f"bad{number}.run"
            file.write_bytes(content)
            page.open_file(file)
            page.page.wait_for_selector(f".notice.error:has-text('{file.name}'):has-text('{message}')")
            assert page.js("bubblesim.playback.run === null")


WATCH = """async (source) => {
  const video = document.createElement("video");
  video.src = source;
  await new Promise((done, fail) => { video.onloadeddata = done; video.onerror = () => fail(video.error.message); });
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: video.videoWidth, height: video.videoHeight });
  const seen = () => {
    const context = canvas.getContext("2d");
    context.drawImage(video, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  const seek = async (time) => {
    video.currentTime = time;
    await new Promise((done) => (video.onseeked = done));
  };
  await seek(0);
  const first = seen();
  await seek(video.duration - 0.05);
  const change = () => seen().reduce((most, value, i) => Math.max(most, Math.abs(value - first[i])), 0);
  let most = change();
  for (let i = 0; i < 100 && most === 0; i++) {
    await new Promise((done) => setTimeout(done, 20)); // a busy browser draws the picture later
    most = change();
  }
  return { width: video.videoWidth, height: video.videoHeight, duration: video.duration, change: most };
}"""


def watch(browser: Browser, file: Path) -> dict[str, float]:
    """Play a video in an empty page of the browser; `change` is the largest of a value from its begin to its end."""
    page = browser.new_page()
    source = "data:video/webm;base64," + base64.b64encode(file.read_bytes()).decode()
    found: dict[str, float] = page.evaluate(WATCH, source)
    page.close()
    return found


def test_a_video_of_a_run_plays(tmp_path: Path, show: Show, browser: Browser) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        after(page, 1.5)
        page.page.keyboard.press("l")
        page.page.click("button:has-text('Video…')")
        page.page.select_option(".saving select[aria-label=Size]", label="640 x 360")
        with page.page.expect_download() as download:
            page.page.click(".saving button[type=submit]")
        file = tmp_path / download.value.suggested_filename
        download.value.save_as(file)
        page.page.wait_for_selector(".saving", state="detached")
        length = page.js(f"{RUN}.end - {RUN}.begin")
        # The view has its size again.
        assert page.js("bubblesim.view.renderer.domElement.width") == page.js(
            "Math.floor(bubblesim.view.element.clientWidth * window.devicePixelRatio)"
        )
        video = watch(browser, file)
        assert (video["width"], video["height"]) == (640, 360)
        assert video["duration"] == pytest.approx(length, abs=0.1)
        assert video["change"] > 60  # the ball is elsewhere


def test_a_video_of_the_view_plays(tmp_path: Path, show: Show, browser: Browser) -> None:
    with Node(tmp_path, "ball") as node:
        page = show(node)
        page.js("bubblesim.layout.show('record')")
        page.page.click("button:has-text('Record a video')")
        page.page.wait_for_selector("button:has-text('End the video')")
        page.look_from_above()
        page.page.wait_for_timeout(1000)
        with page.page.expect_download() as download:
            page.page.click("button:has-text('End the video')")
        file = tmp_path / download.value.suggested_filename
        download.value.save_as(file)
        video = watch(browser, file)
        assert video["duration"] > 1
        assert video["change"] > 60


def test_colour_cameras_show_what_they_saw(tmp_path: Path, show: Show) -> None:
    note = "document.querySelector(\"[data-camera$='/Camera'] .hint\").textContent"
    with Node(tmp_path, "sensors") as node:
        page = show(node)
        after(page, 0.5)
        page.js("bubblesim.layout.show('cameras')")
        page.page.keyboard.press("l")
        page.wait(f"{note}.includes('playback at')")
        depth = "document.querySelector(\"[data-camera$='/DepthCamera'] .hint\").textContent"
        page.wait(f"{depth}.includes('not in a playback')")
        page.page.keyboard.press("l")
        page.wait(f"!{note}.includes('playback')")
