"""Pictures with an ICC profile, such as those of phones in Display P3, as sRGB."""

import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from PIL.Image import Image


def is_srgb(profile: bytes) -> bool:
    """Whether a profile calls itself sRGB, as most do."""
    from PIL import ImageCms

    try:
        name = ImageCms.getProfileDescription(ImageCms.ImageCmsProfile(io.BytesIO(profile)))
    except (ImageCms.PyCMSError, OSError, ValueError, TypeError):
        return False
    return "srgb" in name.lower()


def in_srgb(image: "Image", profile: bytes) -> tuple["Image", list[str]]:
    """The picture of 8 bits in sRGB, and what is to be told of a profile that can't be followed."""
    from PIL import ImageCms

    if is_srgb(profile):
        return image, []
    modes = {"LA": "L", "RGBA": "RGB", "P": "RGB", "PA": "RGB", "1": "L"}
    plain = image.convert(modes[image.mode]) if image.mode in modes else image
    try:
        source = ImageCms.ImageCmsProfile(io.BytesIO(profile))
        target = ImageCms.createProfile("sRGB")
        intent = ImageCms.Intent.RELATIVE_COLORIMETRIC
        turned = ImageCms.profileToProfile(plain, source, target, intent, outputMode="RGB")
    except (ImageCms.PyCMSError, OSError, ValueError, TypeError) as error:
        reason = " ".join(str(error).split())[:100]
        return image, [f"its ICC profile isn't heeded, and colours taken for sRGB's: {reason}"]
    return turned or image, []
