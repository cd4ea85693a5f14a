"""What the lectures teach beside the six effects, and other renderers' conventions: stages that replace the core's."""
