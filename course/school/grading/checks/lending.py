"""Whether a function is judged beside the student's other functions or the reference's: in all of its checks alike.

A function should not pay for the mistake of another that it calls. So where a check fails, it is asked again in a
second process, in which the functions above are the course's own. But a file can tell the two processes apart, and
could give one answer in each. So all checks of a function are judged in one process, the first that all of its checks
so far agree with: the second counts only if it passes whatever the first has passed, and then the first is not asked
any more.
"""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace

from course.school.grading.checks.check import Caller, Check
from course.school.grading.checks.result import Result, Status
from course.school.grading.errors import StudentError

Substitutes = Callable[[str], Caller | None]
"""function -> the same student's module, with the reference's in place of the functions that come before it."""

Outcome = tuple[Result, StudentError | None]

STANDS_ON = "Right by itself: the check passes when the functions above it, which this one calls, are the course's own."


class Lending:
    """Asks the checks of one module.

    Parameters
    ----------
    attempt : (check, caller, reference_caller) -> how it ended
    caller : of the student's functions alone
    reference_caller : the reference, to compare times with
    substitutes : who is asked again
    """

    def __init__(
        self,
        attempt: Callable[[Check, Caller, Caller | None], Outcome],
        caller: Caller,
        reference_caller: Caller | None,
        substitutes: Substitutes,
    ) -> None:
        self._attempt, self._caller, self._reference_caller = attempt, caller, reference_caller
        self._substitutes = substitutes
        self._passed: defaultdict[str, list[Check]] = defaultdict(list)
        self._lent: dict[str, bool] = {}

    def asked(
        self, check: Check, *, lent_first: bool
    ) -> tuple[Result, StudentError | None, Caller]:
        """How the check ended, the error where there was one, and with which functions.

        ``lent_first``: the other way round, because a function above it never ends: whoever calls that one would be
        waited for in vain
        """
        function = check.function
        decided = self._lent.get(function)
        lent = self._with_reference(check) if decided or (lent_first and decided is None) else None
        if lent and (decided or self._settled(check, lent)):
            return lent
        result, error = self._attempt(check, self._caller, self._reference_caller)
        if result.status is Status.PASSED:
            self._passed[function].append(check)
            return result, error, self._caller
        # What isn't in the file or not written yet, or is in a file that can't be used, is nobody else's mistake.
        stub = error is not None and error.kind == "not written" and f".{function}:" in str(error)
        alone = error is not None and (error.kind == "missing" or error.module_wide or stub)
        if not alone and decided is None and result.status is not Status.GRADER_ERROR:
            # It may have waited for the function that never ends; what is wrong with it itself says more.
            if lent and result.status is Status.TIMEOUT:
                return lent
            lent = lent or self._with_reference(check)
            # A function that failed and has asked for nothing that was lent would only be tried twice.
            borrowed = result.status is not Status.FAILED or getattr(
                lent and lent[2], "borrowed", True
            )
            if lent and borrowed and self._settled(check, lent):
                return lent
        return result, error, self._caller

    def _with_reference(self, check: Check) -> tuple[Result, StudentError | None, Caller] | None:
        """How it ends with the reference's functions above; None where no function comes before."""
        substitute = self._substitutes(check.function)
        if substitute is None:
            return None
        result, error = self._attempt(check, substitute, None)
        hint = STANDS_ON if result.status is Status.PASSED else result.hint
        return replace(result, hint=hint), error, substitute

    def _settled(self, check: Check, lent: tuple[Result, StudentError | None, Caller]) -> bool:
        """Settle beside whose functions this one is judged, if the check has passed there: true for the reference's."""
        if lent[0].status is not Status.PASSED:
            return False
        earlier = (self._with_reference(each) for each in self._passed[check.function])
        self._lent[check.function] = all(
            each and each[0].status is Status.PASSED for each in earlier
        )
        return self._lent[check.function]
