"""The report: what it holds, and what a real browser makes of it."""

from __future__ import annotations

import re
from html.parser import HTMLParser

import browser
import numpy as np
import pfgeom
import pytest
import shapes
from pfgeom.report_figures import histogram, sizes
from pfgeom.report_pictures import VIEWS, colours_of, draw, heat_map


@pytest.fixture(scope="module")
def page(tmp_path_factory, gear_model):
    path = tmp_path_factory.mktemp("report") / "gear.html"
    pfgeom.report(path, shapes.gear(), gear_model, title="a <gear> & more")
    return path


def test_the_page_is_whole_and_needs_no_network(page, gear_model):
    text = page.read_text(encoding="utf-8")
    assert "a &lt;gear&gt; &amp; more" in text and "<gear>" not in text
    assert not re.search(r"""(?:src|href)=(?!["']?data:)""", text)
    assert "http" not in text and "$" not in text
    assert f"{gear_model.nbytes:,}" in text and str(gear_model.functions) in text
    assert text.count("data:image/png;base64,") == 6
    assert len(text) < 2_000_000
    opened: list[str] = []

    class Checker(HTMLParser):
        def handle_starttag(self, tag, attributes):
            opened.append(tag)
            names = dict(attributes)
            assert tag != "img" or names["alt"]
            assert tag != "input" or names["aria-label"]
            assert tag != "svg" or names["aria-label"]

    Checker().feed(text)
    assert opened.count("table") == opened.count("caption") == 5


def test_figures_are_those_of_compare(page, gear_model):
    found = pfgeom.compare(shapes.gear(), gear_model)
    text = page.read_text(encoding="utf-8")
    for value in (found.a_to_b.max, found.b_to_a.rms, found.a_to_b.mean, found.max_bound):
        assert f"{value:.3e}" in text


needs_chromium = pytest.mark.skipif(browser.CHROMIUM is None, reason="no Chromium here: apt-get install chromium")


@needs_chromium
def test_a_browser_shows_it_and_the_slider_moves(page, tmp_path):
    script = """
      const slider = document.querySelector("input[type=range]");
      const after = document.querySelector(".compare .after");
      const cuts = [];
      for (const value of [50, 20]) {
        slider.value = value;
        slider.dispatchEvent(new Event("input"));
        cuts.push(getComputedStyle(after).clipPath);
      }
      const images = [...document.images].map((image) => image.complete && image.naturalWidth);
      return { cuts, images, wide: document.documentElement.scrollWidth - innerWidth };
    """
    light = browser.look(page, script, tmp_path)
    assert light.console == []
    assert light.answer["cuts"] == ["inset(0px 0px 0px 50%)", "inset(0px 0px 0px 20%)"]
    assert light.answer["images"] == [720] * 6
    assert light.answer["wide"] <= 0
    assert len(np.unique(light.pixels.reshape(-1, 3), axis=0)) > 500  # pictures, not a blank page
    moved = browser.look(page, script.replace("[50, 20]", "[20, 50]"), tmp_path)
    assert (light.pixels != moved.pixels).any()

    dark = browser.look(page, "return matchMedia('(prefers-color-scheme: dark)').matches", tmp_path, dark=True)
    assert dark.answer is True
    assert light.pixels[2, 2].mean() > 200 > 60 > dark.pixels[2, 2].mean()
    narrow = browser.look(page, "return document.documentElement.scrollWidth - innerWidth", tmp_path, (500, 900))
    assert narrow.answer <= 0


def test_command_line_with_and_without_a_model(command_line, tmp_path):
    pfgeom.write_mesh(tmp_path / "ball.ply", *shapes.sphere())
    made = command_line("report", "ball.ply", "ball.html", "--tolerance", "5e-3", "--json")
    assert made.returncode == 0, made.stderr
    pfgeom.compress(*shapes.sphere(), tolerance=5e-3).save(tmp_path / "ball.pfg")
    again = command_line("report", "ball.ply", "ball.pfg", "again.html")
    assert again.returncode == 0, again.stderr
    one, two = ((tmp_path / name).read_text(encoding="utf-8") for name in ("ball.html", "again.html"))
    assert one == two
    assert "ellipsoid" in one or "sphere" in one
    assert command_line("report", "ball.ply", "ball.txt").returncode == 2
    assert command_line("report", "absent.ply", "x.html").returncode == 1
    assert not (tmp_path / "x.html").exists()


def test_pixels_lie_on_the_surface_and_heat_shows_the_side(sphere_model):
    vertices, faces = shapes.sphere(4)
    mesh = pfgeom.Mesh(vertices, faces.astype(np.int32))
    drawing = draw(mesh, mesh, VIEWS[0], 0, None)
    seen = np.isfinite(drawing.points).all(axis=-1)
    assert 0.2 < seen.mean() < 0.8
    assert np.abs(np.linalg.norm(drawing.points[seen], axis=-1) - 1).max() < 0.01
    for factor, warmer in ((1.05, True), (0.95, False)):  # a larger surface lies outside: red
        heat = heat_map(drawing, pfgeom.Mesh(factor * vertices, mesh.faces), 0.05, 0, None)[seen].astype(int)
        assert ((heat[:, 0] > heat[:, 2]) == warmer).mean() > 0.99
    np.testing.assert_array_equal(colours_of(np.zeros(1)), [[238, 236, 230]])


def test_histogram_knows_sides_and_sizes_are_measured(sphere_model):
    vertices, faces = shapes.sphere(4)
    mesh, other = (pfgeom.Mesh(f * vertices, faces.astype(np.int32)) for f in (1.0, 1.02))
    found = histogram(mesh, other, 0.04, 0, None)
    assert found.shares.sum() == pytest.approx(1)
    inner = (found.edges[:-1] > 0.01) & (found.edges[1:] < 0.03)
    assert found.shares[inner].sum() > 0.99
    assert histogram(other, mesh, 0.04, 0, None).shares[found.edges[1:] <= 0].sum() > 0.99

    by_name = {size.name: size for size in sizes(mesh, sphere_model, 1e-3)}
    assert by_name["raw"].bytes == 12 * (len(vertices) + len(faces)) > by_name["gzip"].bytes
    assert by_name["pfgeom"].bytes == sphere_model.nbytes
    pytest.importorskip("DracoPy")
    draco = next(size for name, size in by_name.items() if name.startswith("Draco"))
    assert draco.bytes < by_name["gzip"].bytes and draco.deviation <= 1e-3
