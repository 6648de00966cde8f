"""Sliders only where there is somebody to move them."""

import pytest
from jupyter_client.manager import start_new_kernel

from mamttsp.figures import explore

CODE = """
from mamttsp.figures import explore
explore(lambda time, agents: print(f"{time} s, {agents} agents"), time=(0.0, 150.0, 0.5, 60.0), agents=(1, 5, 1, 2))
"""


@pytest.fixture(scope="module")
def kernel():
    manager, client = start_new_kernel(kernel_name="python3")
    yield client
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def _messages(kernel, allow_stdin):
    found = []
    reply = kernel.execute_interactive(CODE, allow_stdin=allow_stdin, output_hook=found.append, timeout=60)
    assert reply["content"]["status"] == "ok"
    return [message["content"] for message in found]


def test_without_a_kernel_it_draws_once():
    calls = []
    explore(lambda **values: calls.append(values), time=(0.0, 150.0, 0.5, 60.0), agents=(1, 5, 1, 2))
    assert calls == [{"time": 60.0, "agents": 2}]


def test_where_nobody_can_answer_there_is_no_widget(kernel):
    messages = _messages(kernel, allow_stdin=False)
    assert [content["text"] for content in messages if "text" in content] == ["60.0 s, 2 agents\n"]
    assert not [content for content in messages if "comm_id" in content]


def test_where_somebody_is_there_are_sliders_with_their_ranges(kernel):
    states = [content["data"]["state"] for content in _messages(kernel, allow_stdin=True) if "target_name" in content]
    sliders = {state["description"]: state for state in states if "min" in state and "max" in state}
    time, agents = sliders["time"], sliders["agents"]
    assert (time["_model_name"], time["min"], time["max"], time["value"]) == ("FloatSliderModel", 0.0, 150.0, 60.0)
    assert (agents["_model_name"], agents["min"], agents["max"], agents["value"]) == ("IntSliderModel", 1, 5, 2)
