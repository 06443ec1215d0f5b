"""What the plans of both clients have in common."""

from dataclasses import dataclass

from kcs import _contract, machine, summary
from kcs.machine import Machine
from kcs.summary import Notice, Summary


@dataclass(frozen=True, repr=False)
class PlanRecord:
    """A plan as the server told it when it was made."""

    name: str
    """"plans/" and the SHA-256 of the request: ``client.get(name)`` finds it again."""
    machine: Machine
    """The machine, with the limits that hold."""
    tolerance_mm: float
    """How far the tool may leave the programmed path at a corner, unless the program says otherwise, mm."""
    summary: Summary
    """Cycle time, and what else it amounts to."""
    notices: tuple[Notice, ...]
    """What the reader of the G-code noticed, and planned around."""

    def __repr__(self) -> str:
        """What a prompt shows: one line; ``print(plan.summary)`` says more."""
        return f"<Plan {self.name!r}: {self.summary.cycle_time_s:.3f} s on {self.machine.name or 'a machine without name'}>"


def from_message(message: _contract.Message) -> PlanRecord:
    return PlanRecord(
        name=message.name,
        machine=machine.from_message(message.options.machine),
        tolerance_mm=message.options.tolerance_mm,
        summary=summary.from_message(message.summary),
        notices=tuple(Notice(notice.line, notice.text, notice.count) for notice in message.notices),
    )
