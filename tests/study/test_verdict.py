"""What is said of an answer: right, wrong, not answered yet, and never an error."""

import pytest

from mamttsp.study.verdict import judge


def demand(true, *words):
    """An assertion as a notebook makes it; pytest would add words of its own here."""
    if not true:
        raise AssertionError(*words)


def check_square(square):
    for x in (0, 3):
        demand(square(x) == x * x, f"x = {x}: you say {square(x)}, it is {x * x}")
    return ["0 and 3 are squared"]


def unwritten(x):
    raise NotImplementedError("replace this line")


def stops(x):
    return 1 / x


def said(capsys, check, *answers):
    judge("Task", check, *answers)
    return capsys.readouterr().out


def test_right(capsys):
    assert said(capsys, check_square, lambda x: x**2) == "0 and 3 are squared\nTask: right\n"
    assert said(capsys, lambda f: None, len) == "Task: right\n"


def test_wrong_with_the_case(capsys):
    assert said(capsys, check_square, lambda x: x) == "Task: wrong: x = 3: you say 3, it is 9\n"


def test_not_answered_yet(capsys):
    assert said(capsys, check_square, unwritten) == "Task: not answered yet\n"


def test_an_answer_that_stops_names_its_call(capsys):
    assert said(capsys, check_square, stops) == "Task: wrong: stops(0) stops with ZeroDivisionError: division by zero\n"


def test_a_value_that_cannot_be_used_is_shown(capsys):
    line = said(capsys, lambda square: square(3) + 1, lambda x: None)
    assert line.startswith("Task: wrong: <lambda>(3) gives None, and the check cannot use it: TypeError: unsupported")


def test_a_name_that_is_no_function_is_wrong(capsys):
    assert said(capsys, check_square, 42.0).startswith("Task: wrong: the answer(0) stops with TypeError")


def test_one_line_however_much_there_is_to_say(capsys):
    def check(answer):
        demand(answer() is None, "many\n" * 1000)

    line = said(capsys, check, lambda: 1)
    assert line.count("\n") == 1 and len(line) < 300


def test_a_fault_of_the_check_is_raised():
    def check(answer):
        demand(answer() is None)

    with pytest.raises(AssertionError):
        judge("Task", check, lambda: 1)
