from .html_sheet import sheet_html as sheet_html
from .pdf_page import pdf_bytes as pdf_bytes
from .pdf_sheet import sheet_pages as sheet_pages
from .text_sheet import sheet_text as sheet_text
from .workbook import report_tables as report_tables
from .workbook import workbook_bytes as workbook_bytes
