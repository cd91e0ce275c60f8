"""render_order: lower is drawn first, before distance, within opaque and within translucent nodes."""

import itertools

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.panes import LAYERS, front, pane
from tests.helpers import copies
from tests.reference.compositing import composite


def orders_of(scene, orders):
    for node, order in zip(scene.nodes, orders, strict=True):
        node.render_order = order


@pytest.mark.parametrize("orders", list(itertools.permutations((-5, 0, 7))))
def test_translucent_panes(any_path, orders):
    scene = cc.Scene(background=(0.3, 0.6, 0.9, 1))
    for layer in LAYERS:
        pane(scene, *layer)
    orders_of(scene, orders)
    ranked = [LAYERS[index] for index in np.argsort(orders)]
    want = composite(scene.background, *[(*color, alpha) for color, alpha, _ in ranked])
    color = front(scene)(any_path).color
    assert_close(color, np.broadcast_to(want, color.shape), "blend")


def test_distance_decides_within_one_order(renderer):
    """The middle pane is drawn last; the other two have one order and are drawn from far to near."""
    scene = cc.Scene(background=(0.3, 0.6, 0.9, 1))
    for layer in LAYERS:
        pane(scene, *layer)
    orders_of(scene, (3, 4, 3))
    near, middle, far = [(*color, alpha) for color, alpha, _ in LAYERS]
    color = front(scene)(renderer).color
    want = composite(scene.background, far, near, middle)
    assert_close(color, np.broadcast_to(want, color.shape), "blend")


@pytest.mark.parametrize("orders", list(itertools.permutations((-(2**31), 0, 2**31 - 1))))
def test_opaque_things_at_one_depth(any_path, orders):
    """The thing that is drawn first stays visible."""
    scene = cc.Scene()
    colors = np.eye(3)
    for color in colors:
        pane(scene, color, 1, -3)
    orders_of(scene, orders)
    color = front(scene)(any_path).color
    np.testing.assert_array_equal(color[2, 2, :3], colors[np.argmin(orders)])


def test_opaque_things_still_hide_by_depth(renderer):
    scene = cc.Scene()
    for color, _, z in LAYERS:
        pane(scene, color, 1, z)
    for orders in itertools.permutations(range(3)):
        orders_of(scene, orders)
        np.testing.assert_allclose(front(scene)(renderer).color[1, 1, :3], LAYERS[0][0])


def test_translucent_things_come_after_opaque_ones_all_the_same(renderer):
    scene = cc.Scene(background=(0, 0, 0, 1))
    pane(scene, *LAYERS[0]).render_order = -9
    pane(scene, (1, 1, 0), 1, -5).render_order = 9
    color = front(scene)(renderer).color
    want = composite((1, 1, 0, 1), (*LAYERS[0][0], LAYERS[0][1]))
    assert_close(color, np.broadcast_to(want, color.shape), "blend")


def test_a_changed_order_is_drawn(renderer, fresh_renderer):
    scene = cc.Scene(background=(0.3, 0.6, 0.9, 1))
    for layer in LAYERS:
        pane(scene, *layer)
    draw = front(scene)
    before = draw(renderer).color
    scene.nodes[0].render_order = -1
    after = draw(renderer).color
    assert renderer.stats.views_drawn == 1
    assert (before != after).any()
    assert_identical(after, draw(fresh_renderer).color)
    scene.nodes[0].render_order = 0
    assert_identical(draw(renderer).color, before)


def test_an_order_that_changes_nothing_draws_nothing(renderer):
    scene = cc.Scene()
    for layer in LAYERS:
        pane(scene, *layer)
    draw = front(scene)
    draw(renderer)
    for node, order in zip(scene.nodes, (4, -2, -(2**31)), strict=True):
        node.render_order = order  # they are drawn so already: far to near
    draw(renderer)
    assert renderer.stats.views_drawn == 0


def test_it_is_the_nodes_own(renderer):
    scene = cc.Scene()
    group = scene.add(render_order=5)
    child = scene.add(cc.Mesh.box(), parent=group)
    assert (group.render_order, child.render_order) == (5, 0)


@copies
def test_copies_keep_it(make_copy):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(), render_order=-7)
    loose = scene.add(render_order=2**31 - 1)
    assert [node.render_order for node in make_copy(scene).nodes] == [-7, 2**31 - 1]
    scene.remove(loose)
    assert make_copy(loose).render_order == 2**31 - 1


BAD = {
    "too large": (2**31, ValueError, "render_order.*2147483647.*2147483648"),
    "too small": (-(2**31) - 1, ValueError, "render_order"),
    "huge": (10**40, ValueError, "render_order"),
    "float": (1.5, TypeError, "render_order.*int.*1.5"),
    "bool": (True, TypeError, "render_order.*True"),
    "None": (None, TypeError, "render_order.*None"),
    "text": ("first", TypeError, "render_order.*first"),
}


@pytest.mark.parametrize(("value", "error", "text"), BAD.values(), ids=BAD)
def test_bad_orders(value, error, text):
    scene = cc.Scene()
    with pytest.raises(error, match=text):
        scene.add(cc.Mesh.box(), render_order=value)
    assert not scene.nodes
    node = scene.add(cc.Mesh.box(), render_order=np.int16(3))
    with pytest.raises(error, match=text):
        node.render_order = value
    assert node.render_order == 3
