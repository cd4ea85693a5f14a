"""The reference of the command line, from the program itself."""

import re
from inspect import cleandoc

import click

from course.cli.main import commands
from sitebuild.place import Place


def command_line(place: Place, name: str = "", words: str = "") -> str:  # noqa: ARG001
    """Return the reference as Markdown: a heading for each command, with its usage and its options."""
    root = click.Context(commands, info_name="course")
    lines = []
    for name in commands.list_commands(root):
        command = commands.get_command(root, name)
        assert command is not None
        lines += _section(command, click.Context(command, info_name=name, parent=root))
    return "\n".join(lines)


def _section(command: click.Command, context: click.Context) -> list[str]:
    usage = " ".join([context.command_path, *command.collect_usage_pieces(context)])
    # Names of files may hold underscores and stars; angle brackets would be taken for HTML.
    about = re.sub(r"(?<!`)([*_<])(?!`)", r"\\\1", cleandoc(command.help or "")).replace("\f", "")
    lines = [f"## course {context.info_name}", "", "```text", usage, "```", "", about, ""]
    for parameter in command.get_params(context):
        record = parameter.get_help_record(context)
        # The arguments stand in the usage; only options have a text.
        if record is not None and record[1]:
            names, text = record
            lines += [f"`{names}`", f": {_escaped(' '.join(text.split()))}", ""]
    return lines


def _escaped(text: str) -> str:
    return re.sub(r"([*_<\[\]])", r"\\\1", text)
