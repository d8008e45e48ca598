from .example import ClipAnalysis as ClipAnalysis
from .example import analyse as analyse
from .example import read_analysis as read_analysis
from .example import reconstruct as reconstruct
from .example import write_analysis as write_analysis
from .flow import advect as advect
from .flow import flow_map as flow_map
from .flow import optical_flow as optical_flow
from .flow_painting import paint_flow as paint_flow
from .flow_painting import propose_flow as propose_flow
from .flow_painting import refine_flow as refine_flow
from .flow_painting import streaks as streaks
from .appearance import collapse_pyramid as collapse_pyramid
from .appearance import match_histogram as match_histogram
from .appearance import match_texture as match_texture
from .appearance import motion_blur as motion_blur
from .appearance import steerable_pyramid as steerable_pyramid
from .images import linear_to_srgb as linear_to_srgb
from .images import read as read
from .images import read_clip as read_clip
from .images import read_flow as read_flow
from .images import srgb_to_linear as srgb_to_linear
from .images import write as write
from .images import write_flow as write_flow
from .inpainting import inpaint as inpaint
from .inpainting import make_cyclic as make_cyclic
from .layers import displace as displace
from .layers import over as over
from .matting import foreground as foreground
from .matting import matte as matte
from .matting import trimap as trimap
from .motion import Ripple as Ripple
from .motion import Wind as Wind
from .motion import bob as bob
from .motion import drift as drift
from .motion import ripple as ripple
from .motion import sway as sway
from .motion import wave_heights as wave_heights
from .peeling import peel as peel
from .recipe import Document as Document
from .recipe import RecipeError as RecipeError
from .recipe import load as load
from .recipe import parse as parse
from .render.live import Live as Live

__version__: str

class BadInput(ValueError): ...
class FileError(OSError): ...
class Cancelled(RuntimeError): ...
class NotConverged(RuntimeError): ...
