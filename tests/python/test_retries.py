"""What is tried again, against a server that fails when it is told to."""

import asyncio
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import grpc
import kcs
import kcs.aio
import numpy as np
import pytest
from kcs import _contract

PLAN = "plans/" + "0" * 64


class FailingServer:
    """Answers each method by a function of the call's number, from 1, and its request."""

    def __init__(self) -> None:
        self.answers: dict[str, Callable[[int, Any], Any]] = {}
        self.calls: dict[str, int] = {}
        self._server = grpc.server(ThreadPoolExecutor(4))
        methods = {
            "GetPlan": (grpc.unary_unary_rpc_method_handler, "GetPlanRequest"),
            "DeletePlan": (grpc.unary_unary_rpc_method_handler, "DeletePlanRequest"),
            "StreamSetpoints": (grpc.unary_stream_rpc_method_handler, "StreamSetpointsRequest"),
        }
        handlers = {
            name: make(self._answering(name), request_deserializer=self._parsing(request))
            for name, (make, request) in methods.items()
        }
        health = grpc.unary_unary_rpc_method_handler(lambda request, context: b"")
        self._server.add_generic_rpc_handlers(
            (
                grpc.method_handlers_generic_handler(_contract.SERVICE, handlers),
                grpc.method_handlers_generic_handler("grpc.health.v1.Health", {"Check": health}),
            )
        )
        port = self._server.add_insecure_port("localhost:0")
        # So patient that a busy computer ends no call before its last attempt.
        self.connection = kcs.Connection(f"localhost:{port}", patience_s=60)
        self._server.start()

    @staticmethod
    def _parsing(request: str) -> Callable[[bytes], Any]:
        return _contract.message_class(f"kcs.v1.{request}").FromString  # type: ignore[no-any-return]

    def _answering(self, method: str) -> Callable[[Any, Any], Any]:
        def answer(request: Any, context: Any) -> Any:
            self.calls[method] = self.calls.get(method, 0) + 1
            try:
                return self.answers[method](self.calls[method], request)
            except InterruptedError:
                context.abort(grpc.StatusCode.UNAVAILABLE, "the store cannot be reached")

        def answers(request: Any, context: Any) -> Iterator[bytes]:
            self.calls[method] = self.calls.get(method, 0) + 1
            try:
                yield from self.answers[method](self.calls[method], request)
            except InterruptedError:
                context.abort(grpc.StatusCode.UNAVAILABLE, "the store cannot be reached")

        return answers if method == "StreamSetpoints" else answer

    def stop(self) -> None:
        self._server.stop(None)


@pytest.fixture
def failing() -> Iterator[FailingServer]:
    server = FailingServer()
    yield server
    server.stop()


def a_plan(call: int, request: Any) -> bytes:
    plan = _contract.PlanMessage(name=PLAN)
    plan.summary.cycle_time_s = 1.0
    return bytes(plan.SerializeToString())


def nothing(call: int, request: Any) -> bytes:
    return b""


def failing_until(call_that_works: int, answer: Callable[[int, Any], bytes]) -> Callable[[int, Any], bytes]:
    def answers(call: int, request: Any) -> bytes:
        if call < call_that_works:
            raise InterruptedError
        return answer(call, request)

    return answers


def breaking_setpoints(call: int, request: Any) -> Iterator[bytes]:
    """Setpoints 0 to 29, ten a batch; the first calls break after one batch."""
    batch_class = _contract.message_class("kcs.v1.SetpointBatch")
    for first in range(request.first_index, 30, 10):
        if call < 3 and first > request.first_index:
            raise InterruptedError
        batch = batch_class(first_index=first)
        batch.position_mm.add().values.extend(_contract.to_packed(np.arange(first, first + 10)))
        yield bytes(batch.SerializeToString())


def test_a_question_is_asked_again_when_the_server_cannot_answer_just_then(failing: FailingServer) -> None:
    failing.answers["GetPlan"] = failing_until(3, a_plan)
    with kcs.Client(failing.connection) as client:
        assert client.get(PLAN).name == PLAN
    assert failing.calls["GetPlan"] == 3


def test_but_not_for_ever(failing: FailingServer) -> None:
    failing.answers["GetPlan"] = failing_until(100, a_plan)
    with kcs.Client(failing.connection) as client, pytest.raises(kcs.Error, match="the store cannot be reached"):
        client.get(PLAN)
    assert failing.calls["GetPlan"] == 4


def test_what_would_answer_otherwise_the_second_time_is_not_asked_again(failing: FailingServer) -> None:
    failing.answers["DeletePlan"] = failing_until(2, nothing)
    with kcs.Client(failing.connection) as client, pytest.raises(kcs.Error) as failure:
        client.delete(PLAN)
    assert failure.value.code == "UNAVAILABLE"
    assert failing.calls["DeletePlan"] == 1


def test_setpoints_go_on_where_they_broke(failing: FailingServer) -> None:
    failing.answers |= {"GetPlan": a_plan, "StreamSetpoints": breaking_setpoints}
    with kcs.Client(failing.connection) as client:
        setpoints = client.get(PLAN).setpoints(0.1)
    assert np.array_equal(setpoints.position_mm[:, 0], np.arange(30))
    assert failing.calls["StreamSetpoints"] == 3


def test_setpoints_that_bring_nothing_more_are_given_up(failing: FailingServer) -> None:
    def broken(call: int, request: Any) -> Iterator[bytes]:
        raise InterruptedError
        yield

    failing.answers |= {"GetPlan": a_plan, "StreamSetpoints": broken}
    with kcs.Client(failing.connection) as client, pytest.raises(kcs.Error, match="the store cannot be reached"):
        client.get(PLAN).setpoints(0.1)
    assert failing.calls["StreamSetpoints"] == 4


def test_with_asyncio_too(failing: FailingServer) -> None:
    failing.answers |= {"GetPlan": failing_until(2, a_plan), "StreamSetpoints": breaking_setpoints}

    async def positions() -> Any:
        async with kcs.aio.Client(failing.connection) as client:
            return (await (await client.get(PLAN)).setpoints(0.1)).position_mm

    assert np.array_equal(asyncio.run(positions())[:, 0], np.arange(30))
    assert failing.calls == {"GetPlan": 2, "StreamSetpoints": 3}
