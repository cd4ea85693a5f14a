"""Tables for who plans a course: ``<!-- site: plan six weeks -->`` of weeks, ``<!-- site: minutes -->`` of modules."""

from course.base.errors import CourseError
from sitebuild.objectives import title
from sitebuild.place import Place
from sitebuild.teaching_file import minutes, teaching


def plan(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Return a plan as a Markdown table: week, modules, what else is done, hours of a student.

    Raises
    ------
    CourseError
        There is no plan of that name.
    """
    plans = teaching().plans
    asked = f"{name} {words}".strip()
    if asked not in plans:
        raise CourseError(f"no plan {asked!r} in docs/teaching.yaml; it has {', '.join(plans)}")
    lines = ["| week | modules | and | hours |", "| ---: | --- | --- | ---: |"]
    for number, week in enumerate(plans[asked], start=1):
        links = ", ".join(f"[{title(each)}](../modules/{each}.md)" for each in week.modules)
        hours = sum(sum(minutes(each)) for each in week.modules) / 60
        lines.append(f"| {number} | {links} | {week.also} | {hours:.1f} |")
    return "\n".join(lines)


def minutes_table(place: Place, name: str = "", words: str = "") -> str:  # noqa: ARG001
    """Return a Markdown table of all modules: minutes, what each builds on, what it takes for granted."""
    modules = teaching().modules
    lines = [
        "| module | reading | writing | rendering | builds on | takes for granted |",
        "| --- | ---: | ---: | ---: | --- | --- |",
    ]
    for each, module in modules.items():
        needs = ", ".join(title(need) for need in module.needs)
        knows = "; ".join(module.knows)
        times = " | ".join(str(number) for number in minutes(each))
        lines.append(f"| [{title(each)}](../modules/{each}.md) | {times} | {needs} | {knows} |")
    return "\n".join(lines)
