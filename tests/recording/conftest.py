"""The browser that looks at pages of the site looks at views of rays, too."""

from tests.docs.conftest import browser

__all__ = ["browser"]
